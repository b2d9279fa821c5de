// Matrix Market files: what is read, and what is refused at which line.
#include "ch03_impulse_lcp/matrix_market.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "common/errors.hpp"

namespace fc::lcp {
namespace {

class MatrixMarket : public testing::Test {
 protected:
  std::filesystem::path file_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("fc_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".mtx");

  MatX read(const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    return read_matrix_market(file_);
  }
  // The message, without the file's path.
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      const std::string what = error.what(), path = file_.string();
      EXPECT_EQ(what.find('\n'), std::string::npos);
      return what.starts_with(path) ? what.substr(path.size()) : what;
    }
    return "accepted";
  }
  void TearDown() override { std::filesystem::remove(file_); }
};

TEST_F(MatrixMarket, ReadsAnArrayColumnByColumn) {
  EXPECT_EQ(read("%%MatrixMarket matrix array real general\n% a comment\n2 3\n1\n2\n3\n4\n5e-1\n+6\n"),
            (MatX{{1, 3, 0.5}, {2, 4, 6}}));
}

TEST_F(MatrixMarket, ReadsCoordinates) {
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate integer general\n%\n%c\n2 2 2\n1 2 7\n2 1 -3"),
            (MatX{{0, 7}, {-3, 0}}));
}

TEST_F(MatrixMarket, MirrorsSymmetricEntries) {
  EXPECT_EQ(read("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 4\n2 1 -3\n"),
            (MatX{{4, -3}, {-3, 0}}));
  EXPECT_EQ(read("%%MatrixMarket matrix array real symmetric\r\n2 2\r\n1\r\n2\r\n3\r\n"),
            (MatX{{1, 2}, {2, 3}}));
}

TEST_F(MatrixMarket, RefusesBadInputAtItsLine) {
  const std::string array = "%%MatrixMarket matrix array real general\n",
                    sparse = "%%MatrixMarket matrix coordinate real general\n";
  EXPECT_TRUE(refusal("").starts_with(":1:1: not a Matrix Market file"));
  EXPECT_TRUE(refusal(std::string("\0\1\2", 3)).starts_with(":1:1: not a Matrix Market file"));
  EXPECT_NE(refusal("%%MatrixMarket matrix array complex general\n1 1\n1 0\n").find("'complex'"),
            std::string::npos);
  EXPECT_NE(refusal("%%MatrixMarket matrix array real hermitian\n1 1\n1\n").find("'hermitian'"),
            std::string::npos);
  EXPECT_TRUE(refusal(array + "2 1\n1\nnan\n").starts_with(":4:1: 'nan'"));
  EXPECT_TRUE(refusal(array + "2 1\n1\n1e999\n").starts_with(":4:1: '1e999'"));
  EXPECT_TRUE(refusal(array + "2 1\n1\n 2x\n").starts_with(":4:2: '2x'"));
  EXPECT_NE(refusal(array + "2 1\n1\n").find("the file ends"), std::string::npos);
  EXPECT_TRUE(refusal(array + "1 1\n1\n2\n").starts_with(":4:1: more entries"));
  EXPECT_TRUE(refusal(array + "-1 1\n").starts_with(":2:1: '-1'"));
  EXPECT_NE(refusal(array + "100000 100000\n").find("too large"), std::string::npos);
  EXPECT_TRUE(refusal(sparse + "2 2 1\n3 1 5\n").starts_with(":3:1: '3'"));
  EXPECT_NE(refusal(sparse + "2 2 2\n1 1 5\n1 1 5\n").find("given twice"), std::string::npos);
  EXPECT_NE(
      refusal("%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 2 5\n2 1 5\n").find("given twice"),
      std::string::npos);
  EXPECT_NE(refusal("%%MatrixMarket matrix array real symmetric\n1 2\n1\n").find("square"),
            std::string::npos);
  EXPECT_THROW(read_matrix_market("/nonexistent.mtx"), InputError);
}

TEST(MatrixMarketFile, ReadsWhatItWrites) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "fc_written.mtx";
  const double third = 1.0 / 3, tiny = std::numeric_limits<double>::denorm_min();
  for (const MatX& matrix :
       {MatX{{third, -2e300}, {-2e300, tiny}}, MatX{{1, 2}, {third, 4}}, MatX{{third}, {2}}}) {
    write_matrix_market(file, matrix);
    EXPECT_EQ(read_matrix_market(file), matrix);
  }
  std::filesystem::remove(file);
  EXPECT_THROW(write_matrix_market("/no/such/folder/A.mtx", MatX{{1}}), std::runtime_error);
}

}  // namespace
}  // namespace fc::lcp

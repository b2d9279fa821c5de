// Matrix Market files: what is read, and what is refused at which line.
#include "ch03_impulse_lcp/matrix_market.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "common/errors.hpp"
#include "common/number_text.hpp"
#include "tests/support/text_forms.hpp"

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
  EXPECT_TRUE(refusal(std::string("\0\1\2", 3)).starts_with(":1:1: a zero byte"));
  EXPECT_NE(refusal("%%MatrixMarket matrix array complex general\n1 1\n1 0\n").find("'complex'"),
            std::string::npos);
  EXPECT_NE(refusal("%%MatrixMarket matrix array real hermitian\n1 1\n1\n").find("'hermitian'"),
            std::string::npos);
  EXPECT_TRUE(refusal(array + "2 1\n1\nnan\n").starts_with(":4:1: 'nan'"));
  EXPECT_TRUE(refusal(array + "2 1\n1\n1e999\n").starts_with(":4:1: '1e999'"));
  EXPECT_TRUE(
      refusal(array + "2 1\n1\n 2x\n").starts_with(":4:2: expected an entry of the matrix, found '2x'"));
  EXPECT_NE(refusal(array + "2 1\n1\n").find("the file ends"), std::string::npos);
  EXPECT_TRUE(refusal(array + "1 1\n1\n2\n").starts_with(":4:1: '2' is one entry more"));
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

const std::string kArray = "%%MatrixMarket matrix array real general\n";
const std::string kSparse = "%%MatrixMarket matrix coordinate real general\n";

TEST_F(MatrixMarket, MarksAndLineEndsChangeNothing) {
  for (const auto& [form, bytes] :
       fc_test::forms_of(kSparse + "% a remark\n\n2 2 2\n1 2 7\n% another\n2 1 -3\n"))
    EXPECT_EQ(read(bytes), (MatX{{0, 7}, {-3, 0}})) << form;
  for (const auto& [form, bytes] : fc_test::forms_of(kArray + "2 2\n1\n2\n3\n4"))
    EXPECT_EQ(read(bytes), (MatX{{1, 3}, {2, 4}})) << form;
  for (const auto& [form, bytes] : fc_test::forms_of(kArray + "2 2\n1\n  two\n"))
    EXPECT_EQ(refusal(bytes), ":4:3: expected an entry of the matrix, found 'two'; write a number") << form;
}

TEST_F(MatrixMarket, FormsOfNumbersChangeNothing) {
  for (const std::string& three : fc_test::kThrees) {
    EXPECT_EQ(read(kArray + "2 1\n" + three + "\n1\n"), (MatX{{3}, {1}})) << three;
    EXPECT_EQ(read(kSparse + "+2 2 +1\n+1 02 " + three + "\n"), (MatX{{0, 3}, {0, 0}})) << three;
  }
  for (const std::string& no_number : fc_test::kNoNumbers) {
    const std::string line = refusal(kArray + "1 1\n" + no_number + "\n");
    EXPECT_TRUE(line.starts_with(":3:1: ")) << line;
    EXPECT_NE(line.find("'" + no_number + "'"), std::string::npos) << line;
  }
  const std::string whole = "%%matrixmarket MATRIX Coordinate Integer General\n1 1 1\n1 1 ";
  EXPECT_EQ(read(whole + "+3\n"), (MatX{{3}}));
  EXPECT_EQ(refusal(whole + "3.0\n"),
            ":3:5: expected an entry of the matrix, found '3.0'; write a whole number");
  EXPECT_EQ(refusal(kSparse + "1 1 1\n1.0 1 3\n"), ":3:1: expected a row, found '1.0'; write a whole number");
}

// Where an entry stands says which one it is, so that a line has one; a vector has no such doubt.
TEST_F(MatrixMarket, NothingMoreStandsInALine) {
  EXPECT_EQ(refusal(kArray + "2 2\n1 2\n3 4\n"),
            ":3:3: found '2' after an entry; write one entry a line, column by column");
  EXPECT_EQ(read(kArray + "3 1\n1 2\n3\n"), (MatX{{1}, {2}, {3}}));
  EXPECT_EQ(read(kArray + "1 3\n1 2 3\n"), (MatX{{1, 2, 3}}));
  EXPECT_EQ(refusal(kArray + "3 1\n1 2 3 4\n"),
            ":3:7: '4' is one entry more than the size line says; check the size line");
  EXPECT_EQ(refusal(kSparse + "2 2 1\n1 1 5 0\n"),
            ":3:7: found '0' after an entry; write row, column and value, one entry a line");
  EXPECT_EQ(refusal(kSparse + "2 2 1\n1 1\n5\n"),
            ":3:4: the line ends where an entry of the matrix should stand; complete it");
  EXPECT_EQ(refusal(kSparse + "2 2 1 1\n1 1 5\n"),
            ":2:7: found '1' after the matrix's size; write its entries below, one a line");
  EXPECT_EQ(refusal(kArray.substr(0, kArray.size() - 1) + " dense\n1 1\n5\n"),
            ":1:42: found 'dense' after the five words of the first line; remove it");
  EXPECT_TRUE(refusal("%%MatrixMarket matrix array pattern general\n")
                  .starts_with(":1:29: entries of type 'pattern'"));
}

TEST_F(MatrixMarket, WhatIsNoMatrixIsNamed) {
  EXPECT_EQ(refusal("\x1f\x8b\x08 packed"), ": is gzip data, not a Matrix Market file; unpack it first");
  EXPECT_EQ(refusal("\xff\xfe%\0%\0"), ": is UTF-16 text, not a Matrix Market file; save it as UTF-8");
  EXPECT_EQ(
      refusal(kArray + std::string("1 1\n1\0\n", 7)),
      ":3:2: a zero byte: binary data, so it is not a Matrix Market file; check the file's name and content");
}

RC_GTEST_FIXTURE_PROP(MatrixMarket, NoLineIsPassedOver, ()) {
  const std::string word =
      *rc::gen::container<std::string>(*rc::gen::inRange(1, 8), rc::gen::inRange<char>('!', '~'));
  double ignored = 0;
  RC_PRE(word[0] != '%' && !read_c_number(word, ignored));
  std::vector<std::string> lines = {kArray, "% a remark\n", "2 1\n", "1\n", "2\n"};
  const auto at = *rc::gen::inRange<std::size_t>(0, lines.size() + 1);
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), word + "\n");
  std::string text;
  for (const std::string& line : lines) text += line;
  RC_ASSERT(refusal(text).starts_with(":" + std::to_string(at + 1) + ":1: "));
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

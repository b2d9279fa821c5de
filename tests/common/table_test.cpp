#include "common/table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "common/errors.hpp"

namespace {

std::filesystem::path temporary(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("first_contact_table_" + name);
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Table, WritesUnitsAndShortestNumbers) {
  const auto file = temporary("plain.csv");
  fc::TableWriter table(file, {{"query", ""}, {"toc", "1"}, {"gap", "m"}, {"status", ""}});
  table.row({0, 0.1, 1e-6, "contact"});
  table.row({1, 1.0, std::numeric_limits<double>::infinity(), "separated, proved \"clear\""});
  table.close();
  EXPECT_EQ(contents(file),
            "query,toc [1],gap [m],status\n"
            "0,0.1,1e-06,contact\n"
            "1,1,inf,\"separated, proved \"\"clear\"\"\"\n");
}

TEST(Table, RefusesBadRows) {
  fc::TableWriter table(temporary("bad.csv"), {{"a", ""}, {"b", ""}});
  EXPECT_THROW(table.row({1.0}), fc::NumericalFailure);
  EXPECT_THROW(table.row({1.0, 2.0, 3.0}), fc::NumericalFailure);
  EXPECT_THROW(table.row({1.0, ""}), fc::NumericalFailure);
  EXPECT_THROW(table.row({1.0, std::nan("")}), fc::NumericalFailure);
  table.row({1.0, 2.0});
  table.close();
  EXPECT_EQ(contents(temporary("bad.csv")), "a,b\n1,2\n");  // a refused row leaves nothing behind
  EXPECT_THROW(table.row({1.0, 2.0}), fc::NumericalFailure);
}

TEST(Table, SaysWhichColumnFailed) {
  fc::TableWriter table(temporary("named.csv"), {{"t", "s"}, {"energy", "J"}});
  try {
    table.row({0.0, std::nan("")});
    FAIL();
  } catch (const fc::NumericalFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("energy"), std::string::npos) << failure.what();
  }
}

TEST(Table, AFileThatCannotBeOpenedIsBadInput) {
  EXPECT_THROW(fc::TableWriter(temporary("no_such_folder") / "x.csv", {{"a", ""}}), fc::InputError);
}

TEST(Table, AFullDiskIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "skipped: no /dev/full here";
  fc::TableWriter table("/dev/full", {{"a", ""}});
  table.row({1.0});
  EXPECT_THROW(table.close(), std::runtime_error);
}

RC_GTEST_PROP(Table, NumbersReadBackExactly, (double x)) {
  RC_PRE(!std::isnan(x));
  const double read = std::stod(fc::cell_text(x));
  RC_ASSERT(std::memcmp(&read, &x, sizeof x) == 0);
}

}  // namespace

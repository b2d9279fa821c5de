#include "common/number_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>

namespace {

using fc::NumberText;
using fc::read_number;

NumberText kind(const char* text) {
  double ignored = 0;
  return read_number(text, ignored);
}

double value(const char* text) {
  double x = NAN;
  EXPECT_EQ(read_number(text, x), NumberText::finite) << text;
  return x;
}

TEST(NumberText, ReadsDecimalNumbers) {
  EXPECT_EQ(value("0"), 0);
  EXPECT_EQ(value("10"), 10);
  EXPECT_EQ(value("-0.5"), -0.5);
  EXPECT_EQ(value("+3"), 3);
  EXPECT_EQ(value(".5"), 0.5);
  EXPECT_EQ(value("5."), 5);
  EXPECT_EQ(value("1e3"), 1000);
  EXPECT_EQ(value("1.0E-6"), 1e-6);
  EXPECT_EQ(value("0.016666666666666666"), 1.0 / 60);
  EXPECT_EQ(value("007.5"), 7.5);  // a whole number with zeros before it is ambiguous: eight or ten?
  EXPECT_EQ(value("01e1"), 10);
}

TEST(NumberText, RefusesWhatOthersReadDifferently) {
  for (const char* text : {"",     "-",     ".",   "e5",  "1e",   "1e+",   "010", "-010", "+00", "0x10",
                           "0o10", "1_000", "1,5", "1 2", "true", "1.2.3", "--1", "+-1",  "1f",  "0b1"}) {
    EXPECT_EQ(kind(text), NumberText::not_a_number) << text;
  }
}

TEST(NumberText, TellsWhatIsNotFinite) {
  for (const char* text : {".inf", "-.inf", "+.Inf", ".nan", ".NaN", "nan", "inf", "-Infinity"}) {
    EXPECT_EQ(kind(text), NumberText::not_finite) << text;
  }
  EXPECT_EQ(kind("1e999"), NumberText::too_large);
  EXPECT_EQ(kind("1e-999"), NumberText::too_large);
}

// What C's strtod reads to the text's end, and nothing else.
bool strtod_reads(const std::string& text, double& x) {
  char* end = nullptr;
  x = std::strtod(text.c_str(), &end);
  return !text.empty() && !std::isspace(static_cast<unsigned char>(text[0])) && *end == '\0';
}

void expect_as_strtod(const std::string& text) {
  double ours = 0, theirs = 0;
  const bool reads = strtod_reads(text, theirs);
  ASSERT_EQ(fc::read_c_number(text, ours), reads) << text;
  if (reads && !std::isnan(theirs)) {
    EXPECT_EQ(ours, theirs) << text;
    EXPECT_EQ(std::signbit(ours), std::signbit(theirs)) << text;
  }
}

TEST(CNumber, IsReadAsStrtodReadsIt) {
  for (const char* text :
       {"0",         "-0",  "+3.0E+00", ".5",  "5.",   "1e5",     "010",    "0x1p3",   "-0X.8P1",  "0x",
        "0xp1",      "inf", "-INF",     "nan", "+NaN", "1e999",   "1e-999", "-1e-999", "4.9e-324", "2e-324",
        "0x1p-1080", "1d3", "1,5",      "1f",  "--1",  "+-1",     "-+1",    "0x-1",    "0xinf",    "1e",
        "1e+",       ".",   "+",        "",    "1 2",  "infinit", "1.2.3",  "e5",      "0x1.8",    "0x1g"})
    expect_as_strtod(text);
}

RC_GTEST_PROP(CNumber, AnyWordIsReadAsStrtodReadsIt, ()) {
  const auto letter = rc::gen::elementOf(std::string("0123456789+-.eExXpPaAfinN"));
  expect_as_strtod(*rc::gen::container<std::string>(letter));
}

TEST(WholeNumber, HasDigitsAlone) {
  const auto read = [](const char* text) {
    long long x = -1;
    return fc::read_whole_number(text, x) == std::errc() ? x : -1;
  };
  EXPECT_EQ(read("7"), 7);
  EXPECT_EQ(read("+7"), 7);
  EXPECT_EQ(read("007"), 7);
  EXPECT_EQ(read("-7"), -7);
  for (const char* text :
       {"", "+", "-", "+-7", "--7", "7.0", "7e0", "0x7", "7 ", "seven", "99999999999999999999"})
    EXPECT_EQ(read(text), -1) << text;
  long long ignored = 0;
  EXPECT_EQ(fc::read_whole_number("99999999999999999999", ignored), std::errc::result_out_of_range);
}

RC_GTEST_PROP(NumberText, ReadsBackEveryDouble, (double x)) {
  RC_PRE(std::isfinite(x));
  double read = 0;
  RC_ASSERT(read_number(fmt::format("{}", x), read) == NumberText::finite);
  RC_ASSERT(read == x);
}

}  // namespace

#include "common/number_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

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
}

TEST(NumberText, RefusesWhatOthersReadDifferently) {
  for (const char* text : {"",     "-",     ".",   "e5",  "1e",   "1e+",   "010", "-010", "00.5", "0x10",
                           "0o10", "1_000", "1,5", "1 2", "true", "1.2.3", "--1", "+-1",  "1f",   "0b1"}) {
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

RC_GTEST_PROP(NumberText, ReadsBackEveryDouble, (double x)) {
  RC_PRE(std::isfinite(x));
  double read = 0;
  RC_ASSERT(read_number(fmt::format("{}", x), read) == NumberText::finite);
  RC_ASSERT(read == x);
}

}  // namespace

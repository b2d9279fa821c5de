#include "common/text.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace {

TEST(Text, EditDistanceOfKnownPairs) {
  EXPECT_EQ(fc::edit_distance("", ""), 0u);
  EXPECT_EQ(fc::edit_distance("", "abc"), 3u);
  EXPECT_EQ(fc::edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(fc::edit_distance("raduis", "radius"), 1u);  // neighbours swapped
  EXPECT_EQ(fc::edit_distance("gravty", "gravity"), 1u);
}

RC_GTEST_PROP(Text, EditDistanceIsSymmetricAndBounded, (const std::string& a, const std::string& b)) {
  const std::size_t distance = fc::edit_distance(a, b);
  RC_ASSERT(distance == fc::edit_distance(b, a));
  RC_ASSERT((distance == 0) == (a == b));
  RC_ASSERT(distance <= std::max(a.size(), b.size()));
  RC_ASSERT(distance >= std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
}

TEST(Text, NearestTakesTheFirstOfEquals) {
  EXPECT_EQ(fc::nearest("mas", {"density", "mass", "mast"}), "mass");
  EXPECT_EQ(fc::nearest("x", {}), "");
}

RC_GTEST_PROP(Text, OneLineIsOneLine, (const std::string& text)) {
  const std::string line = fc::one_line(text);
  RC_ASSERT(
      std::none_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }));
}

RC_GTEST_PROP(Text, FileNamesStayInsideTheirFolder, (const std::string& text)) {
  const std::string name = fc::file_name_from(text);
  RC_ASSERT(!name.empty() && name.size() <= 100 && name[0] != '.');
  RC_ASSERT(name.find('/') == std::string::npos && name.find('\0') == std::string::npos);
}

TEST(Text, LongQuotesAreShortened) {
  EXPECT_EQ(fc::in_quotes("a\nb"), "'a\\x0ab'");
  EXPECT_LT(fc::in_quotes(std::string(1000, 'x')).size(), 70u);
}

TEST(Text, ListsOfWords) {
  EXPECT_EQ(fc::one_of({}), "");
  EXPECT_EQ(fc::one_of({"a"}), "a");
  EXPECT_EQ(fc::one_of({"a", "b", "c"}), "a, b or c");
}

TEST(Text, PaddingCountsCharactersNotBytes) {
  EXPECT_EQ(fc::padded("µm", 4), "µm  ");
}

}  // namespace

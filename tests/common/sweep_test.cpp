#include "common/sweep.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "common/errors.hpp"

namespace {

using Values = std::vector<std::string>;

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Sweep, SplitsAtTopLevelCommasOnly) {
  EXPECT_EQ(fc::parse_sweep("ccd.tolerance=1e-3,1e-6").values, (Values{"1e-3", "1e-6"}));
  EXPECT_EQ(fc::parse_sweep("gravity=[0,0,-9.81],[0, 0, -1.62]").values,
            (Values{"[0,0,-9.81]", "[0, 0, -1.62]"}));
  EXPECT_EQ(fc::parse_sweep("shapes.a={sphere: {radius: 1}, mass: 2},{mass: 1}").values.size(), 2u);
  EXPECT_EQ(fc::parse_sweep("name='a,b',\"c,d\"").values, (Values{"'a,b'", "\"c,d\""}));
  EXPECT_EQ(fc::parse_sweep("name=x").key, "name");
}

TEST(Sweep, RefusesWhatIsNoSweep) {
  for (const char* text : {"", "ccd.tolerance", "=1,2", "a=", "a=1,,2", "a=1,", "a= ,1"}) {
    EXPECT_THROW(fc::parse_sweep(text), fc::InputError) << text;
  }
}

TEST(Sweep, FoldersDiffer) {
  const fc::Sweep sweep{"name", {"a b", "a_b", "../x", "a?b"}};
  EXPECT_EQ(fc::sweep_folders(sweep), (Values{"name=a_b", "name=a_b_2", "name=.._x", "name=a_b_3"}));
}

TEST(Sweep, WritesOneRowPerRunWithUnits) {
  fc::Summary first, second;
  first.add("energy drift", 0.25, "J");
  first.add("drift", std::numeric_limits<double>::quiet_NaN(), "m");
  first.counter("lcp", 3, 700);
  second.add("energy drift", 0.5, "J");
  second.add("note", "short, but here");
  const fc::Sweep sweep{"bodies.0.grid.spacing", {"[1,1,1]", "[2,2,2]"}};
  const auto file = std::filesystem::path(testing::TempDir()) / "first_contact_sweep.csv";
  fc::write_sweep(file, sweep, {{"[1,1,1]", first, 0}, {"[2,2,2]", second, 3}});
  EXPECT_EQ(contents(file),
            "bodies.0.grid.spacing [m],energy drift [J],drift [m],note,lcp_runs,lcp_ns,exit_code\n"
            "\"[1,1,1]\",0.25,none,none,3,700,0\n"
            "\"[2,2,2]\",0.5,none,\"short, but here\",none,none,3\n");
}

// The envelope of a run is reported under the name of the key that may be swept.
TEST(Sweep, NamesNoTwoColumnsAlike) {
  fc::Summary summary;
  summary.add("drift", 0.25, "J");
  summary.add("envelope", 1e-4, "m");
  const auto file = std::filesystem::path(testing::TempDir()) / "first_contact_twice.csv";
  fc::write_sweep(file, {"envelope", {"1e-4"}}, {{"1e-4", summary, 0}});
  EXPECT_EQ(contents(file), "envelope [m],drift [J],envelope in the run [m],exit_code\n1e-4,0.25,0.0001,0\n");
}

}  // namespace

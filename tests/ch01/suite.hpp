// Random queries of every pair of kinds and every kind of motion, and what must hold of each answer. CTest
// asks some thousands of them, the executable ch01_suite as many as you like.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ch01_convex_advancement/advance.hpp"
#include "support/ground_truth.hpp"

namespace suite {

enum class Kind { sphere, capsule, box, hull, cylinder, cone };
inline constexpr std::array kKinds = {Kind::sphere, Kind::capsule,  Kind::box,
                                      Kind::hull,   Kind::cylinder, Kind::cone};

enum class Story {
  translating,  // no spin
  slow,         // up to a radian during the query
  fast,         // 1 to 10 turns
  falling,      // accelerated, spinning
  grazing,      // along some plane the gap stays what it is: from -1e-3 to 1e-3 of the size
  near_miss,    // the balls around the bodies pass close by each other, spinning
  far,          // a million sizes from the origin, or coming from a thousand sizes away
  tiny,         // micrometres
  huge,         // a thousand kilometres
  start         // touching, or overlapping, or nearly so, at t = 0
};
inline constexpr std::array kStories = {Story::translating, Story::slow,      Story::fast, Story::falling,
                                        Story::grazing,     Story::near_miss, Story::far,  Story::tiny,
                                        Story::huge,        Story::start};
const char* name_of(Story story);

struct Query {
  truth::Body a, b;
  fc::ca::AdvanceOptions options;
};

// The query with this number of the suite with this seed. Stories and pairs of kinds take turns: each pair
// meets each story once in |stories| |kinds|^2 queries in a row.
Query query_of(std::uint64_t seed, std::uint64_t number);
Story story_of(std::uint64_t number);

// The library's answer to a query.
fc::ca::AdvanceResult ask(const Query& query);
// The same, to a tolerance (m).
fc::ca::AdvanceResult ask(const Query& query, double tolerance);

struct Verdict {
  fc::ca::Status status = fc::ca::Status::unresolved;
  std::string wrong;         // what does not hold; empty: all does
  bool undecided = false;    // the reference could not tell whether the pair was clear before toc
  bool uncertified = false;  // a contact whose gap_lower is not > 0: allowed, but GJK's bounds did not meet
  int looks = 0;             // of the reference
};

// What is checked, for each answer:
//   missed, late      no contact before toc, nor during the interval if `separated`: the whole time from 0 to
//                     toc is proved clear by the reference, with the distance at few chosen times
//   false contact     at toc the true distance is within the tolerance
//   the two gaps      the true distance lies between them, and gap_upper within the tolerance for a contact
//   the start         overlaps where it is said to, touches where it is said to, is clear otherwise
//   monotonicity      with an eighth of the tolerance the contact is not earlier, and none comes out of
//                     `separated`
//   the certificate   replayed: all of it, for every fourth query
Verdict check(const Query& query, std::uint64_t number);

}  // namespace suite

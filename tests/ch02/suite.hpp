// Random queries of meshes of every kind and every kind of motion, and what must hold of each answer. CTest
// asks some thousands of them, the executable ch02_suite as many as you like.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ch02_hull_hierarchy/advance.hpp"
#include "support/mesh_truth.hpp"

namespace suite {

enum class Kind {
  bumpy,       // a ball with bumps and dents
  torus,       // smooth
  lumpy,       // star-shaped, with deep valleys
  knot,        // a tube along a trefoil
  sheet,       // open, wavy, perhaps rolled up
  soup,        // triangles anywhere, needles among them
  plate,       // with holes; large flat faces
  components,  // several balls, one of them hollow
  coarse,      // 4 to 20 triangles
  slivers,     // squeezed to needles
  sphere,
  capsule,
  box,
  hull
};
const char* name_of(Kind kind);
inline constexpr std::array kMeshKinds = {Kind::bumpy,  Kind::torus,  Kind::lumpy, Kind::knot,
                                          Kind::sheet,  Kind::soup,   Kind::plate, Kind::components,
                                          Kind::coarse, Kind::slivers};
inline constexpr std::array kKinds = {
    Kind::bumpy,      Kind::torus,  Kind::lumpy,   Kind::knot,   Kind::sheet,   Kind::soup, Kind::plate,
    Kind::components, Kind::coarse, Kind::slivers, Kind::sphere, Kind::capsule, Kind::box,  Kind::hull};

enum class Story {
  translating,  // no spin
  slow,         // up to a radian during the query
  fast,         // 1 to 10 turns
  falling,      // accelerated, spinning; or thrown away from each other, and pulled back
  turning,      // side by side, into each other or not by their spins alone
  grazing,      // along some plane the gap stays what it is: from -1e-3 to 1e-3 of the size
  sliding,      // from a tiny gap somewhere, along it, turning a little
  near_miss,    // past each other, half-way a small gap apart, spinning
  far,          // a million sizes from the origin, or coming from a thousand sizes away
  start,        // touching, overlapping, one inside the other, or nearly so, at t = 0
  parked        // no motion at all, nor relative to each other, or no time
};
inline constexpr std::array kStories = {Story::translating, Story::slow,    Story::fast,    Story::falling,
                                        Story::turning,     Story::grazing, Story::sliding, Story::near_miss,
                                        Story::far,         Story::start,   Story::parked};
const char* name_of(Story story);

// A body for the reference and for the library.
struct Prepared {
  truth::MeshShape shape;
  fc::hulls::Model model;
  std::string what;  // for people
};
Prepared prepare(const fc::TriangleMesh& mesh, bool solid, std::string what);

struct Query {
  std::shared_ptr<const Prepared> a, b;
  truth::Flight flight_a, flight_b;
  fc::ca::AdvanceOptions options;
  Story story = Story::translating;
  bool limited = false;  // to fewer iterations than it may need

  truth::MeshBody body_a() const { return {&a->shape, flight_a}; }
  truth::MeshBody body_b() const { return {&b->shape, flight_b}; }
};

// The queries of the suite with this seed. As many in a row as there are stories have the same two shapes;
// kinds take turns: each mesh kind meets each kind once in |stories| |mesh kinds| |kinds| queries.
class Queries {
 public:
  explicit Queries(std::uint64_t seed) : seed_(seed) {}
  Query at(std::uint64_t number);

 private:
  std::uint64_t seed_, pair_ = ~0ull;
  double size_ = 1;  // m
  std::shared_ptr<const Prepared> first_, second_;
};
Story story_of(std::uint64_t number);

// Pairs of one mesh, about `size` m large: a third each far away, near (first gap 1e-3 to 2e-2 of the size),
// and grazing.
enum class Approach { far, near, grazing };
const char* name_of(Approach approach);
Approach approach_of(std::uint64_t number);
Query query_of_one_mesh(std::shared_ptr<const Prepared> mesh, std::uint64_t seed, std::uint64_t number);

// The bunny about its centre of mass; null if it is not there.
std::shared_ptr<const Prepared> bunny();

struct Verdict {
  fc::ca::Status status = fc::ca::Status::unresolved;
  std::string wrong;              // what does not hold; empty: all does
  bool limited = false;           // unresolved, of a query that allows few iterations
  bool undecided = false;         // the reference could not tell
  std::int64_t looks = 0;         // of the reference
  double asked = 0, checked = 0;  // s, of wall clock: the library's first answer, all the rest
};

// What is checked, for each answer:
//   missed, late      no contact before toc, nor during the interval if `separated`: all of [0, toc] is
//                     proved clear by the reference
//   false contact     at toc the true distance is within the tolerance
//   the two gaps      the true distance lies between them, and gap_upper within the tolerance for a contact
//   the start         overlaps (or holds the other) where it is said to, touches where it is said to, is
//                     clear otherwise
//   the features      of a contact: on both surfaces, within the tolerance of each other, along a unit normal
//                     from A to B
//   repetition        the same query again, with a certificate: the same answer
//   monotonicity      with an eighth of the tolerance the contact is not earlier, and no contact comes out of
//                     `separated`; what the second answer says is checked as well
//   symmetry          B against A: whatever differs is clear, or a contact, too
Verdict check(const Query& query);

}  // namespace suite

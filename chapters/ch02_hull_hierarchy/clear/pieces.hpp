// Chapter 2's method in its clear form: two pieces, each of which is an exercise.
#pragma once

#include <cstdint>
#include <ostream>
#include <vector>

#include "ch01_convex_advancement/clear/pieces.hpp"

namespace fc::hulls {

struct HullModel;  // hull_model.hpp: a body's convex pieces and their tree

// A node's hull is the convex hull of its points. Rounded by its slack it contains the hulls of both children, so a plane
// that separates two nodes separates everything below them.
struct HullNode {
  std::vector<Vec3> points;    // m, body axes, about the centre of mass
  Vec3 center = Vec3::Zero();  // m: the middle of the points' box
  double radius = 0;           // m, the largest distance of a point from the centre, slack included
  double slack = 0;            // m, how far outside a point may lie that was left out of the hull
  int left = -1, right = -1;   // nodes; -1: a leaf
  int piece = -1;              // leaves: the piece

  bool leaf() const { return left < 0; }
};

struct HullTree {
  std::vector<HullNode> nodes;  // the root is node 0
};

}  // namespace fc::hulls

namespace fc::hulls::clear {

// 2.5: a binary tree over convex pieces, each given by its points (m; at least one piece, at least one point each). A leaf has
// one piece and its points. An inner node's pieces are split at the median along the longest side of the box of their middles
// (the middles of the pieces' own boxes); its points span the hull of both children's points.
using HullTreeFunction = HullTree(const std::vector<std::vector<Vec3>>& pieces);
HullTreeFunction hull_tree;

// What became of a pair of nodes when the search looked at it: for drawings.
struct Look {
  double time;   // s, at which it was looked at
  int a, b;      // nodes
  double gap;    // m, certified
  double speed;  // m/s, a bound of how fast the gap closes; 0 where the gap left no room for a step
  double next;   // s, until when the pair is now proved clear
  enum class Fate { advanced, opened, contact } fate;
};

struct SearchOptions {
  double interval = 1;                   // s
  double target = 5e-7;                  // m, every step aims at this gap
  double slack = 2.5e-7;                 // m: two leaves with a gap of at most target + slack are in contact
  double start = 1e-6;                   // m, the same at t = 0; negative: no gap at t = 0 is a contact
  std::int64_t most_looks = 10'000'000;  // at pairs of nodes
  std::vector<Look>* looks = nullptr;    // receives each look; null: none
};

struct FirstContact {
  enum class Status { contact, clear, limit };
  Status status = Status::clear;
  double time = 0;                 // s; before it all pairs are clear. Status::clear: the interval
  int piece_a = -1, piece_b = -1;  // contact: which pieces
  std::int64_t looks = 0;          // at pairs of nodes
  std::int64_t advances = 0;       // steps that were proved
};
inline std::ostream& operator<<(std::ostream& out, FirstContact::Status status) {
  constexpr const char* kNames[] = {"contact", "clear", "limit"};
  return out << kNames[static_cast<int>(status)];
}

// 2.6: the first time at which two pieces, one of each body, have come to the target gap. Both motions have constant
// acceleration and constant spin.
using SearchFunction = FirstContact(const HullModel& a, const ca::Motion& motion_a, const HullModel& b,
                                    const ca::Motion& motion_b, const SearchOptions& options,
                                    const ca::clear::Pieces& pieces);
SearchFunction search;

struct Pieces {
  ca::clear::Pieces ca;  // chapter 1's
  HullTreeFunction* hull_tree = clear::hull_tree;
  SearchFunction* search = clear::search;
};
// In the order of the exercises, chapter 1's first.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::hulls::clear

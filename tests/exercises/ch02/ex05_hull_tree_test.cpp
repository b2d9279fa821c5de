// Exercise 2.5. Trees over little boxes, whose hulls are compared with what is below them, direction by direction.
#include "ex05_hull_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using fc::Vec3;
using fc::hulls::HullNode;
using fc::hulls::HullTree;
using fc::mine::hull_tree;
using Pieces = std::vector<std::vector<Vec3>>;

constexpr double kSlack = 1e-12;  // of a size of a metre or so

std::vector<Vec3> box(const Vec3& middle, const Vec3& sides) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back(middle + Vec3((k & 1) - 0.5, (k >> 1 & 1) - 0.5, (k >> 2) - 0.5).cwiseProduct(sides));
  return corners;
}

// Boxes here and there, in a space of the given sides.
Pieces scattered(int count, const Vec3& space, int seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> u(-0.5, 0.5);
  Pieces pieces;
  for (int k = 0; k < count; ++k) {
    const Vec3 middle = Vec3(u(random), u(random), u(random)).cwiseProduct(space);
    pieces.push_back(box(middle, Vec3(0.1, 0.05, 0.02)));
  }
  return pieces;
}

const HullNode& node_of(const HullTree& tree, int node) {
  if (node < 0 || node >= static_cast<int>(tree.nodes.size()))
    throw std::out_of_range("node " + std::to_string(node) + " of " + std::to_string(tree.nodes.size()) +
                            ": a child that is not there");
  return tree.nodes[node];
}

// The pieces below a node, from left to right.
std::vector<int> pieces_below(const HullTree& tree, int node, int depth = 0) {
  if (depth > 64)
    throw std::runtime_error("a way down of more than 64 nodes: do two nodes have each other as children?");
  const HullNode& n = node_of(tree, node);
  if (n.leaf()) return {n.piece};
  std::vector<int> all = pieces_below(tree, n.left, depth + 1);
  const std::vector<int> right = pieces_below(tree, n.right, depth + 1);
  all.insert(all.end(), right.begin(), right.end());
  return all;
}

double top(const std::vector<Vec3>& points, const Vec3& d) {
  double most = -1e300;
  for (const Vec3& p : points) most = std::max(most, d.dot(p));
  return most;
}
std::vector<Vec3> directions() {
  std::mt19937_64 random(7);
  std::normal_distribution<double> gauss;
  std::vector<Vec3> all = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (int k = 0; k < 40; ++k) all.push_back(Vec3(gauss(random), gauss(random), gauss(random)).normalized());
  return all;
}

Pieces one() {
  return {box(Vec3(1, 2, 3), Vec3(2, 1, 1))};
}

TEST(Ex05HullTree, OnePieceIsOneLeaf) {
  const HullTree tree = hull_tree(one());
  ASSERT_EQ(tree.nodes.size(), 1u) << "nodes: one piece makes a root that is a leaf";
  EXPECT_TRUE(tree.nodes[0].leaf()) << "the root of one piece has no children";
  EXPECT_EQ(tree.nodes[0].piece, 0) << "the leaf's piece";
  EXPECT_EQ(tree.nodes[0].points, one()[0]) << "a leaf has its piece's points";
  EXPECT_NEAR((tree.nodes[0].center - Vec3(1, 2, 3)).norm(), 0, kSlack)
      << "m: the centre is the middle of the points' box";
  EXPECT_NEAR(tree.nodes[0].radius, std::sqrt(1.5), kSlack)
      << "m: the radius is the largest distance of a point from the centre, here half of the box's diagonal";
}

TEST(Ex05HullTree, EachPieceIsInOneLeaf) {
  for (const int count : {2, 3, 7, 64, 100}) {
    const Pieces pieces = scattered(count, Vec3(2, 1, 1), count);
    const HullTree tree = hull_tree(pieces);
    std::vector<int> found = pieces_below(tree, 0);
    std::sort(found.begin(), found.end());
    std::vector<int> all(count);
    for (int k = 0; k < count; ++k) all[k] = k;
    ASSERT_EQ(found, all)
        << "the pieces in the leaves below the root: a piece that is missing is never seen to touch";
    ASSERT_EQ(static_cast<int>(tree.nodes.size()), 2 * count - 1)
        << "nodes: a binary tree with " << count << " leaves has " << count - 1 << " inner nodes";
    for (const HullNode& node : tree.nodes) {
      if (!node.leaf()) continue;
      ASSERT_EQ(node.points, pieces.at(node.piece)) << "a leaf has the points of its piece, " << node.piece;
    }
  }
}

TEST(Ex05HullTree, AHullHoldsWhatIsBelow) {
  const Pieces pieces = scattered(60, Vec3(2, 1.5, 1), 3);
  const HullTree tree = hull_tree(pieces);
  ASSERT_FALSE(tree.nodes.empty()) << "a tree has at least its root";
  for (int n = 0; n < static_cast<int>(tree.nodes.size()); ++n) {
    const HullNode& node = tree.nodes[n];
    for (const int piece : pieces_below(tree, n))
      for (const Vec3& d : directions())
        ASSERT_GE(top(node.points, d) + node.slack, top(pieces.at(piece), d) - kSlack)
            << "m along " << d.transpose() << ": piece " << piece << " stands out of the hull of node " << n
            << ", which it is below. A plane that clears the node would not clear the piece: a contact would be missed";
  }
}

TEST(Ex05HullTree, AHullHasNoMoreThanWhatIsBelow) {
  const Pieces pieces = scattered(60, Vec3(2, 1.5, 1), 4);
  const HullTree tree = hull_tree(pieces);
  ASSERT_FALSE(tree.nodes.empty()) << "a tree has at least its root";
  for (int n = 0; n < static_cast<int>(tree.nodes.size()); ++n)
    for (const Vec3& d : directions()) {
      double below = -1e300;
      for (const int piece : pieces_below(tree, n)) below = std::max(below, top(pieces.at(piece), d));
      ASSERT_LE(top(tree.nodes[n].points, d), below + kSlack)
          << "m along " << d.transpose() << ": node " << n
          << " reaches beyond all its pieces. That is safe, but it touches others too early, and is opened more often";
    }
}

TEST(Ex05HullTree, ABallAboutTheMiddleHoldsTheNode) {
  const HullTree tree = hull_tree(scattered(50, Vec3(1, 2, 1), 5));
  ASSERT_FALSE(tree.nodes.empty()) << "a tree has at least its root";
  for (int n = 0; n < static_cast<int>(tree.nodes.size()); ++n) {
    const HullNode& node = tree.nodes[n];
    Vec3 low = Vec3::Constant(1e300), high = -low;
    double radius = 0;
    for (const Vec3& p : node.points) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      radius = std::max(radius, (p - node.center).norm());
    }
    ASSERT_NEAR((node.center - 0.5 * (low + high)).norm(), 0, kSlack)
        << "m: centre of node " << n << " from the middle of its points' box";
    ASSERT_NEAR(node.radius, radius, kSlack)
        << "m: radius of node " << n << ", the largest distance of a point from its centre";
  }
}

TEST(Ex05HullTree, IsSplitAtTheMedian) {
  // Ten boxes in a row along y, in no order.
  const std::vector<int> places = {4, 8, 1, 9, 0, 6, 3, 7, 2, 5};
  Pieces pieces;
  for (const int place : places)
    pieces.push_back(box(Vec3(0, place, 0.3 * (place % 2)), Vec3(0.5, 0.5, 0.5)));
  const HullTree tree = hull_tree(pieces);
  const std::vector<int> in_order = pieces_below(tree, 0);
  for (std::size_t k = 0; k < in_order.size(); ++k)
    ASSERT_EQ(places.at(in_order[k]), static_cast<int>(k))
        << "from left to right, leaf " << k << " is the box at y = " << places[in_order[k]]
        << " m: the boxes spread along y, so they are to be sorted along y";
  const HullNode& root = tree.nodes[0];
  EXPECT_EQ(pieces_below(tree, root.left).size(), 5u) << "pieces in the left half of ten";
  EXPECT_EQ(pieces_below(tree, node_of(tree, root.left).left).size(), 2u)
      << "pieces in the left half of five";
}

TEST(Ex05HullTree, TheAxisIsChosenAnewInEachNode) {
  // Two rows along z, far from each other along x.
  Pieces pieces;
  for (const double x : {-5.0, 5.0})
    for (int k = 0; k < 4; ++k) pieces.push_back(box(Vec3(x, 0, k), Vec3(0.2, 0.2, 0.2)));
  const HullTree tree = hull_tree(pieces);
  const HullNode& root = tree.nodes.at(0);
  ASSERT_FALSE(root.leaf()) << "eight pieces make an inner root";
  for (const int child : {root.left, root.right}) {
    EXPECT_LT(node_of(tree, child).radius, 2.0)
        << "m: each half is one of the two rows, 3.2 m long; the first split is across x, where they are 10 m apart";
    const HullNode& row = node_of(tree, child);
    ASSERT_FALSE(row.leaf()) << "a row of four pieces is an inner node";
    EXPECT_LT(node_of(tree, row.left).radius, 0.7)
        << "m: half a row is 1.2 m long: along a row the pieces are split across z";
  }
}

TEST(Ex05HullTree, FlatPiecesAndPointsAreFine) {
  const Pieces pieces = {
      {Vec3(0, 0, 0)}, {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(2, 0, 0)}, {Vec3(0, 3, 0), Vec3(1, 3, 0)}};
  const HullTree tree = hull_tree(pieces);
  ASSERT_EQ(tree.nodes.size(), 5u) << "nodes over a point, a triangle and a segment";
  EXPECT_NEAR(top(tree.nodes[0].points, Vec3::UnitY()), 3, kSlack)
      << "m: the root reaches as far along y as the segment";
  EXPECT_NEAR(top(tree.nodes[0].points, Vec3::UnitX()), 2, kSlack) << "m: and along x as far as the triangle";
}

}  // namespace

#include "ex05_column.hpp"

#include <algorithm>

namespace fc::exercises {
namespace {

// In sums of 10^5 numbers rounding grows with their count: a double would keep 11 digits for sure. These have
// 64 bits instead of 53, and the answer 12 digits.
using Sum = long double;

// Neighbours that push each other and move as one: all have the same x.
struct Block {
  Sum mass = 0;    // kg
  Sum moment = 0;  // kg m, sum of m_i (-R_i)
  std::size_t count = 0;

  Sum x() const { return moment / mass; }  // m, where the sum of m_i (x + R_i)^2 is smallest
};

}  // namespace

// With R_i = r_0 + ... + r_i and x_i = d_i - R_i the rows say that x never falls from box to box, and is at
// least 0 for the first one. Of such x, the nearest to -R: blocks are pooled while one is before another that
// wants less.
Correction correct(std::span<const Box> boxes, bool floor, double width, double share, double gravity) {
  std::vector<Sum> sums;  // R, m
  std::vector<Block> blocks;
  Sum sum = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Sum lacks = 0.5L * width - boxes[i].gap;
    if (i > 0 || floor) sum += lacks > 0 ? share * lacks : lacks;
    sums.push_back(sum);
    blocks.push_back({boxes[i].mass, -boxes[i].mass * sum, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].x() >= blocks.back().x()) {
      const Block upper = blocks.back();
      blocks.pop_back();
      blocks.back().mass += upper.mass;
      blocks.back().moment += upper.moment;
      blocks.back().count += upper.count;
    }
  }

  // What wants to be below 0 stops there: it is on the floor, one block with it.
  std::vector<Sum> x;
  for (const Block& block : blocks)
    x.insert(x.end(), block.count, floor ? std::max(Sum(0), block.x()) : block.x());

  Correction result;
  for (std::size_t i = 0; i < x.size(); ++i) result.displaced.push_back(static_cast<double>(x[i] + sums[i]));
  result.pushes.assign(x.size(), 0);
  Sum above = 0;  // kg m
  for (std::size_t i = x.size(); i-- > 0;) {
    const bool pushes = i > 0 ? x[i] == x[i - 1] : floor && x[i] == 0;
    above = pushes ? std::max(Sum(0), above + boxes[i].mass * (x[i] + sums[i])) : 0;
    result.pushes[i] = static_cast<double>(above);
  }
  result.energy = static_cast<double>(gravity * above);  // the sum of all m_i d_i: what the lowest row pushes
  return result;
}

}  // namespace fc::exercises

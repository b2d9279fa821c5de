// Caught by: Ex05Column.AWideGapTakesItIn
// A gap that has more than h/2 keeps it, and passes everything up.
#include "ex05_column.hpp"

#include <algorithm>

namespace fc::exercises {
namespace {

// Neighbours that push each other and move as one: all have the same x.
struct Block {
  double mass = 0;    // kg
  double moment = 0;  // kg m, sum of m_i (-R_i)
  std::size_t count = 0;

  double x() const { return moment / mass; }  // m, where the sum of m_i (x + R_i)^2 is smallest
};

}  // namespace

// With R_i = r_0 + ... + r_i and x_i = d_i - R_i the rows say that x never falls from box to box, and is at
// least 0 for the first one. Of such x, the nearest to -R: blocks are pooled while one is before another that
// wants less.
Correction correct(std::span<const Box> boxes, bool floor, double width, double share, double gravity) {
  std::vector<double> sums;  // R, m
  std::vector<Block> blocks;
  double sum = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double lacks = 0.5 * width - boxes[i].gap;
    if (i > 0 || floor) sum += lacks > 0 ? share * lacks : 0;
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
  std::vector<double> x;
  for (const Block& block : blocks)
    x.insert(x.end(), block.count, floor ? std::max(0.0, block.x()) : block.x());

  Correction result;
  for (std::size_t i = 0; i < x.size(); ++i) result.displaced.push_back(x[i] + sums[i]);
  result.pushes.assign(x.size(), 0);
  double above = 0;  // kg m
  for (std::size_t i = x.size(); i-- > 0;) {
    const bool pushes = i > 0 ? x[i] == x[i - 1] : floor && x[i] == 0;
    above = pushes ? std::max(0.0, above + boxes[i].mass * result.displaced[i]) : 0;
    result.pushes[i] = above;
  }
  result.energy = gravity * above;  // the sum of all m_i d_i: what the lowest row pushes
  return result;
}

}  // namespace fc::exercises

#include "ch02_hull_hierarchy/show_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fc::hulls {
namespace {

using algorithm::Role;
using algorithm::Step;

constexpr std::size_t kFirst = 12, kLast = 10;  // of the pairs that led to the contact
constexpr std::size_t kQueue = 12;              // pairs of the queue that are shown
constexpr std::size_t kBeside = 3;              // boxes beside the one of this step

// The sides of a box whose corner i has the bits of i for - or + along its axes.
const std::vector<std::array<int, 3>> kSides = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                                {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                                {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};

bool holds(const ca::LeafBlock& block, int leaf_a, int leaf_b) {
  return leaf_a >= block.first_a && leaf_a < block.first_a + block.count_a && leaf_b >= block.first_b &&
         leaf_b < block.first_b + block.count_b;
}

bool is_within(const ca::LeafBlock& inner, const ca::LeafBlock& outer) {
  return holds(outer, inner.first_a, inner.first_b) &&
         holds(outer, inner.first_a + inner.count_a - 1, inner.first_b + inner.count_b - 1);
}

double end_of(const ca::CertificateRow& row) {
  return row.t + row.advance;
}

std::string count_of(int leaves) {
  return leaves == 1 ? "1 leaf" : fmt::format("{} leaves", leaves);
}

void add_box(const BoxTree& tree, int first, int count, const ca::Motion& motion, double t, Role role,
             Step& step) {
  const Pose pose = motion.pose_at(t);
  std::vector<Vec3> corners = box_of_leaves(tree, first, count);
  for (Vec3& corner : corners) corner = pose * corner;
  step.draw.push_back(algorithm::mesh(std::move(corners), kSides, role));
}

// The pairs that wait after the first `rows` rows: those that no later one of these has taken off and opened, or advanced again.
std::vector<std::size_t> waiting_after(const ca::AdvanceResult& result, std::size_t rows) {
  std::vector<std::size_t> waiting;
  for (std::size_t k = 0; k < rows; ++k) {
    const double now = result.certificate[k].t;
    std::erase_if(waiting, [&](std::size_t i) {
      return end_of(result.certificate[i]) <= now &&
             is_within(result.certificate_leaves[k], result.certificate_leaves[i]);
    });
    waiting.push_back(k);
  }
  std::sort(waiting.begin(), waiting.end(), [&](std::size_t x, std::size_t y) {
    const double end_x = end_of(result.certificate[x]), end_y = end_of(result.certificate[y]);
    return end_x != end_y ? end_x < end_y : x < y;
  });
  return waiting;
}

algorithm::Bars queue_of(const CertifiedSearch& search, std::size_t row, double start) {
  algorithm::Bars bars{"the queue, best first: until when each pair is proved clear", "s", {}};
  for (const std::size_t i : waiting_after(search.rows, row + 1)) {
    if (bars.rows.size() == kQueue) break;
    const ca::CertificateRow& r = search.rows.certificate[i];
    const ca::LeafBlock& block = search.rows.certificate_leaves[i];
    const bool beyond = end_of(r) > search.found.time;
    bars.rows.push_back({fmt::format("{} × {}", count_of(block.count_a), count_of(block.count_b)),
                         start + end_of(r),
                         i == row ? Role::now
                         : beyond ? Role::good
                                  : Role::past,
                         i == row ? "this one"
                         : beyond ? "never opened"
                                  : ""});
  }
  return bars;
}

Step row_step(const ShownModels& shown, const CertifiedSearch& search, std::size_t row, double frame_start) {
  const double start = frame_start + shown.from;
  const ca::CertificateRow& r = search.rows.certificate[row];
  const ca::LeafBlock& block = search.rows.certificate_leaves[row];
  Step step;
  step.text = fmt::format(
      "A box of {} against a box of {}, at {:.6g} s: the gap between them is at least {} m, and they are "
      "clear until {:.6g} s. This is pair {} of the {} that got a step.",
      count_of(block.count_a), count_of(block.count_b), start + r.t, algorithm::number(r.gap_lower),
      start + end_of(r), row + 1, search.rows.certificate.size());
  step.poses = {ca::pose_at(shown.number_a, shown.motion_a, r.t),
                ca::pose_at(shown.number_b, shown.motion_b, r.t)};
  add_box(shown.a.boxes, block.first_a, block.count_a, shown.motion_a, r.t, Role::a, step);
  add_box(shown.b.boxes, block.first_b, block.count_b, shown.motion_b, r.t, Role::b, step);
  // The boxes side by side with it, which were opened together: what is proved clear beyond the contact is never opened.
  std::size_t beside = 0;
  for (std::size_t i = row - std::min<std::size_t>(row, 3);
       i < std::min(row + 4, search.rows.certificate.size()); ++i) {
    const ca::LeafBlock& other = search.rows.certificate_leaves[i];
    if (i == row || search.rows.certificate[i].t != r.t || beside == kBeside) continue;
    const bool same_a = other.first_a == block.first_a && other.count_a == block.count_a;
    const bool same_b = other.first_b == block.first_b && other.count_b == block.count_b;
    if (same_a == same_b) continue;
    const Role role = end_of(search.rows.certificate[i]) > search.found.time ? Role::good : Role::past;
    if (same_b) add_box(shown.a.boxes, other.first_a, other.count_a, shown.motion_a, r.t, role, step);
    if (same_a) add_box(shown.b.boxes, other.first_b, other.count_b, shown.motion_b, r.t, role, step);
    ++beside;
  }
  step.bars = queue_of(search, row, start);
  return step;
}

void add_leaf(const Model& model, int leaf, const ca::Motion& motion, double t, Role role, Step& step) {
  const std::span<const Vec3> points = model.boxes.leaf_points(leaf);
  if (points.size() != 3) return;  // not a triangle: the body itself is drawn already
  const Pose pose = motion.pose_at(t);
  step.draw.push_back(
      algorithm::mesh({pose * points[0], pose * points[1], pose * points[2]}, {{0, 1, 2}}, role));
}

Step last_step(const ShownModels& shown, const CertifiedSearch& search, double frame_start,
               std::size_t left_out) {
  const TimeOfContact& found = search.found;
  const double at = frame_start + shown.from + found.time;
  Step step;
  step.poses = {ca::pose_at(shown.number_a, shown.motion_a, found.time),
                ca::pose_at(shown.number_b, shown.motion_b, found.time)};
  if (found.status == TimeOfContact::Status::reached) {
    step.text = fmt::format(
        "At {:.6g} s two leaves have come to {} m: the first contact. All that is still in the queue is "
        "proved clear until then.",
        at, algorithm::number(found.pair.gjk.upper));
    add_leaf(shown.a, found.pair.a, shown.motion_a, found.time, Role::a, step);
    add_leaf(shown.b, found.pair.b, shown.motion_b, found.time, Role::b, step);
    if (found.pair.gjk.status != ca::GjkResult::Status::overlapping) {
      const Vec3 origin = shown.motion_a.position_at(found.time);
      step.draw.push_back(algorithm::point(origin + found.pair.gjk.point_a, Role::a));
      step.draw.push_back(algorithm::point(origin + found.pair.gjk.point_b, Role::b));
    }
  } else if (found.status == TimeOfContact::Status::clear) {
    step.text =
        fmt::format("The queue is empty: every pair is proved clear until the frame's end, {:.6g} s.", at);
  } else {
    step.text =
        fmt::format("The search has looked at as many pairs as the scene allows, and stops at {:.6g} s.", at);
  }
  if (left_out > 0) step.text += fmt::format(" {} pairs on the way here are not shown.", left_out);
  return step;
}

}  // namespace

std::vector<Vec3> box_of_leaves(const BoxTree& tree, int first, int count) {
  NodeId node = 0;
  while (true) {
    const BoxQuad& quad = tree.quads[static_cast<std::size_t>(node >> 2)];
    const auto lane = static_cast<std::size_t>(node & 3);
    if (quad.first_leaf[lane] == first && quad.leaf_count[lane] == count) break;
    const int below = quad.child[lane];
    NodeId next = -1;
    if (below > 0) {
      const BoxQuad& children = tree.quads[static_cast<std::size_t>(below)];
      for (std::size_t k = 0; k < 4 && children.child[k] != 0; ++k)
        if (first >= children.first_leaf[k] &&
            first + count <= children.first_leaf[k] + children.leaf_count[k])
          next = 4 * below + static_cast<int>(k);
    }
    if (next < 0)
      throw std::invalid_argument(fmt::format("no box has the leaves from {} on, {} of them", first, count));
    node = next;
  }
  const BoxQuad& quad = tree.quads[static_cast<std::size_t>(node >> 2)];
  const int k = node & 3;
  const auto lane_of = [k](const Lanes3& v) { return Vec3(v.x[k], v.y[k], v.z[k]); };
  const Vec3 center = lane_of(quad.center), half = lane_of(quad.half), u = lane_of(quad.axis[0]),
             v = lane_of(quad.axis[1]);
  const Vec3 w = u.cross(v);
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    const auto sign = [i](int bit) { return (i >> bit & 1) != 0 ? 1.0 : -1.0; };
    corners.push_back(center + sign(0) * half.x() * u + sign(1) * half.y() * v + sign(2) * half.z() * w);
  }
  return corners;
}

CertifiedSearch certified_search(const ShownModels& shown) {
  CertifiedSearch search;
  SearchMemory memory;
  memory.certificate = &search.rows;
  search.found = time_of_contact(shown.a, shown.motion_a, shown.b, shown.motion_b, shown.options, memory);
  return search;
}

std::vector<std::size_t> rows_to_contact(const CertifiedSearch& search) {
  std::vector<std::size_t> rows;
  const bool met = search.found.status == TimeOfContact::Status::reached;
  for (std::size_t k = 0; k < search.rows.certificate.size(); ++k)
    if (!met || holds(search.rows.certificate_leaves[k], search.found.pair.a, search.found.pair.b))
      rows.push_back(k);
  return rows;
}

std::vector<Step> show_search(const ShownModels& shown, const CertifiedSearch& search, double frame_start) {
  const TimeOfContact& found = search.found;
  std::vector<Step> steps;
  Step first;
  const double all = static_cast<double>(shown.a.boxes.leaves()) * shown.b.boxes.leaves();
  first.text = fmt::format(
      "Bodies {} and {} have {} and {}: {} pairs. The search looks at {} pairs of boxes and {} of leaves, "
      "each time at the pair that could meet first.",
      shown.number_a, shown.number_b, count_of(shown.a.boxes.leaves()), count_of(shown.b.boxes.leaves()),
      algorithm::number(all), found.node_pairs, found.leaf_pairs);
  first.poses = {ca::pose_at(shown.number_a, shown.motion_a, 0),
                 ca::pose_at(shown.number_b, shown.motion_b, 0)};
  add_box(shown.a.boxes, 0, shown.a.boxes.leaves(), shown.motion_a, 0, Role::a, first);
  add_box(shown.b.boxes, 0, shown.b.boxes.leaves(), shown.motion_b, 0, Role::b, first);
  steps.push_back(first);
  const std::vector<std::size_t> rows = rows_to_contact(search);
  std::size_t left_out = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (rows.size() > kFirst + kLast && k >= kFirst && k + kLast < rows.size())
      ++left_out;
    else
      steps.push_back(row_step(shown, search, rows[k], frame_start));
  }
  steps.push_back(last_step(shown, search, frame_start, left_out));
  return steps;
}

}  // namespace fc::hulls

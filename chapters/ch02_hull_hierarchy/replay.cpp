#include "ch02_hull_hierarchy/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <map>
#include <numeric>

namespace fc::hulls {
namespace {

using ca::Long;
using ca::LongVec;

constexpr int kMostHoles = 10;
// The rounding of a point's coordinates in a box, as a share of the model's reach; boxes are built 1e-15 of
// it larger.
constexpr Long kBoxRounding = 64 * LDBL_EPSILON;
constexpr Long kRoundedToc = 1e-15L;  // toc is a fraction of the interval in queries.csv: two roundings

LongVec lane(const Lanes3& x, int k) {
  return {x.x[k], x.y[k], x.z[k]};
}

// A box as it is read: its axes are floats, the third the floats' own product.
struct LongBox {
  LongVec center, half;
  std::array<LongVec, 3> axis;

  LongBox(const BoxQuad& quad, int k) : center(lane(quad.center, k)), half(lane(quad.half, k)) {
    const Lanes3 third = cross(quad.axis[0], quad.axis[1]);
    axis = {lane(quad.axis[0], k), lane(quad.axis[1], k), lane(third, k)};
  }
};

struct Side {
  const Model& model;
  std::map<std::pair<int, int>, NodeId> node_of;  // by first leaf and count
  std::map<NodeId, ca::ReplayShape> corners, points;

  explicit Side(const Model& m) : model(m) {
    const auto& quads = m.boxes.quads;
    for (int q = 0; q < static_cast<int>(quads.size()); ++q)
      for (int k = 0; k < 4 && quads[q].child[k] != 0; ++k)
        node_of[{quads[q].first_leaf[k], quads[q].leaf_count[k]}] = 4 * q + k;
  }

  ca::ReplayShape shape(std::vector<LongVec> of) const {
    ca::ReplayShape result;
    result.radius = model.radius;
    for (const LongVec& p : of) result.reach = std::max(result.reach, p.norm());
    result.points = std::move(of);
    return result;
  }
  bool leaf(NodeId node) const { return model.boxes.child(node) < 0; }

  const ca::ReplayShape& exact(NodeId node) {
    if (const auto found = points.find(node); found != points.end()) return found->second;
    const BoxQuad& quad = model.boxes.quads[node >> 2];
    const int first = quad.first_leaf[node & 3], end = first + quad.leaf_count[node & 3];
    if (model.curved() || !model.parts.empty())
      return points.emplace(node, of_leaves(first, end)).first->second;
    std::vector<int> vertices;  // each once
    if (model.filled) {
      vertices.resize(model.mesh.vertices.size());
      std::iota(vertices.begin(), vertices.end(), 0);
    } else {
      for (int k = first; k < end; ++k)
        for (const int v : model.mesh.triangles[model.boxes.leaf_item[k]]) vertices.push_back(v);
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
    std::vector<LongVec> of;
    for (const int v : vertices) of.push_back(model.mesh.vertices[v].cast<Long>());
    return points.emplace(node, shape(std::move(of))).first->second;
  }
  // The hull of parts, or of something curved, exactly.
  ca::ReplayShape of_leaves(int first, int end) const {
    ca::ReplayShape result;
    for (int leaf = first; leaf < end; ++leaf) {
      const ca::Convex part = model.leaf(leaf);
      for (std::size_t i = 0; i < part.points.size(); ++i) {
        const LongVec p = part.points[i].cast<Long>();
        const Long disk = part.disks.empty() ? 0 : part.disks[i];
        result.points.push_back(p);
        result.disks.push_back(disk);
        result.axes.push_back(part.axis.cast<Long>().normalized());
        result.balls.push_back(part.radius);
        result.reach = std::max(result.reach, p.norm() + disk + Long(part.radius));
      }
    }
    return result;
  }
  // A few points whose hull contains the node's leaves.
  const ca::ReplayShape& simple(NodeId node) {
    if (leaf(node)) return exact(node);
    if (const auto found = corners.find(node); found != corners.end()) return found->second;
    const LongBox box(model.boxes.quads[node >> 2], node & 3);
    std::vector<LongVec> of;
    for (int i = 0; i < 8; ++i) {
      LongVec p = box.center;
      for (int k = 0; k < 3; ++k) p += ((i >> k & 1) ? box.half[k] : -box.half[k]) * box.axis[k];
      of.push_back(p);
    }
    return corners.emplace(node, shape(std::move(of))).first->second;
  }
};

struct Replay {
  const PairQuery& query;
  const std::vector<ca::CertificateRow>& rows;
  const std::vector<ca::LeafBlock>& blocks;
  Long toc;
  Side a{query.a}, b{query.b};
  std::map<std::pair<NodeId, NodeId>, std::vector<int>> rows_of{};
  std::vector<ca::Refusal> wrong{};
  int holes = 0;

  ca::ReplayQuery about(const ca::ReplayShape& shape_a, const ca::ReplayShape& shape_b) const {
    return {shape_a, shape_b, query.motion_a, query.motion_b, query.interval};
  }

  void check_row(int k) {
    const ca::LeafBlock& block = blocks[k];
    const auto node_a = a.node_of.find({block.first_a, block.count_a}),
               node_b = b.node_of.find({block.first_b, block.count_b});
    if (node_a == a.node_of.end() || node_b == b.node_of.end()) {
      wrong.push_back({k, fmt::format("no nodes have the leaves {} + {} and {} + {}", block.first_a,
                                      block.count_a, block.first_b, block.count_b)});
      return;
    }
    const NodeId i = node_a->second, j = node_b->second;
    if (!ca::replay_row(about(a.simple(i), b.simple(j)), rows[k]).empty())
      if (const std::string what = ca::replay_row(about(a.exact(i), b.exact(j)), rows[k]); !what.empty()) {
        wrong.push_back({k, what});
        return;
      }
    rows_of[{i, j}].push_back(k);
  }

  // Checks that the block is clear from `since`, up to which its parents have proved it, until toc.
  void cover(NodeId i, NodeId j, Long since) {
    if (holes >= kMostHoles) return;
    int last = -1;
    if (const auto found = rows_of.find({i, j}); found != rows_of.end()) {
      std::stable_sort(found->second.begin(), found->second.end(),
                       [&](int x, int y) { return rows[x].t < rows[y].t; });
      for (const int k : found->second) {
        if (Long(rows[k].t) > since) break;
        const Long end = Long(rows[k].t) + Long(rows[k].advance);
        if (end <= since) continue;
        since = end;
        last = k;
      }
    }
    if (since >= toc) return;
    if (last >= 0 && since >= toc * (1 - kRoundedToc) &&
        ca::prove_above(about(a.exact(i), b.exact(j)), rows[last].normal.cast<Long>().normalized(), since, 0,
                        0, toc - since)
            .proved)
      return;
    if (a.leaf(i) && b.leaf(j)) {
      ++holes;
      wrong.push_back(
          {last, fmt::format("leaf {} of A and leaf {} of B are proved clear until {:.17g} s only, but toc "
                             "is {:.17g} s",
                             ~query.a.boxes.child(i), ~query.b.boxes.child(j), static_cast<double>(since),
                             static_cast<double>(toc))});
      return;
    }
    // Any partition would do; this is the search's.
    const bool open_a = b.leaf(j) || (!a.leaf(i) && query.a.boxes.radius(i) >= query.b.boxes.radius(j));
    const BoxTree& tree = open_a ? query.a.boxes : query.b.boxes;
    const int below = tree.child(open_a ? i : j);
    for (int k = 0; k < 4 && tree.quads[below].child[k] != 0; ++k)
      open_a ? cover(4 * below + k, j, since) : cover(i, 4 * below + k, since);
  }
};

}  // namespace

std::string check_tree(const Model& model) {
  const BoxTree& tree = model.boxes;
  std::vector<int> items = tree.leaf_item;
  std::sort(items.begin(), items.end());
  const bool whole = model.curved() || !model.parts.empty();  // leaves are given by points around them
  const int count = !model.parts.empty() ? static_cast<int>(model.parts.size())
                    : model.filled       ? 1
                                         : static_cast<int>(model.mesh.triangles.size());
  for (int k = 0; k < static_cast<int>(items.size()); ++k)
    if (items[k] != (model.filled && !whole ? -1 : k))
      return "the leaves are not each triangle, or part, once";
  if (tree.leaves() != count || tree.quads[0].first_leaf[0] != 0 || tree.quads[0].leaf_count[0] != count)
    return "the root has not all leaves";
  for (int leaf = 0; leaf < tree.leaves(); ++leaf) {
    const auto points = tree.leaf_points(leaf);
    for (std::size_t k = 0; k < points.size() && !whole; ++k)
      if (points[k] != model.mesh.vertices[model.filled ? k : model.mesh.triangles[tree.leaf_item[leaf]][k]])
        return "a leaf's points are not its triangle's corners";
  }
  for (std::size_t q = 0; q < tree.quads.size(); ++q)
    for (int k = 0; k < 4 && tree.quads[q].child[k] != 0; ++k) {
      const BoxQuad& quad = tree.quads[q];
      const LongBox box(quad, k);
      Eigen::Matrix<Long, 3, 3> axes;
      axes << box.axis[0], box.axis[1], box.axis[2];
      const Eigen::Matrix<Long, 3, 3> inverse = axes.inverse();
      const int first = quad.first_leaf[k], end = first + quad.leaf_count[k];
      for (int p = tree.leaf_start[first]; p < tree.leaf_start[end]; ++p) {
        const LongVec s = inverse * (tree.points[p].cast<Long>() - box.center);
        if (!(s.cwiseAbs().array() + kBoxRounding * Long(model.reach) <= box.half.array()).all())
          return "a point lies outside a box above it";
      }
      const int child = quad.child[k];
      if (child < 0) {
        if (~child != first || quad.leaf_count[k] != 1) return "a leaf's box is not about the leaf";
        continue;
      }
      int next = first;
      for (int i = 0; i < 4 && tree.quads[child].child[i] != 0; ++i) {
        if (tree.quads[child].first_leaf[i] != next) return "children do not share their parent's leaves";
        next += tree.quads[child].leaf_count[i];
      }
      if (next != end) return "children do not share their parent's leaves";
    }
  return "";
}

std::vector<ca::Refusal> replay(const PairQuery& query, const ca::ReplayAnswer& answer,
                                const std::vector<ca::CertificateRow>& rows,
                                const std::vector<ca::LeafBlock>& blocks) {
  if (!query.motion_a.steady() || !query.motion_b.steady())
    return {{-1, "a body turns freely, or feels drag: only constant spin and acceleration can be replayed"}};
  // Where two bodies touch at the start, other pairs of their nodes have been advanced all the same: their
  // rows prove nothing about the answer.
  const bool at_start =
      answer.status == ca::Status::touching_at_start || answer.status == ca::Status::penetrating_at_start;
  if (const std::string what = ca::replay_answer(query.interval, answer, !at_start && !rows.empty());
      !what.empty())
    return {{-1, what}};
  if (rows.size() != blocks.size())
    return {{-1, fmt::format("the certificate has {} rows, but names the leaves of {}", rows.size(),
                             blocks.size())}};
  Replay replay{query, rows, blocks, Long(answer.toc) * Long(query.interval)};
  for (int k = 0; k < static_cast<int>(rows.size()); ++k) replay.check_row(k);
  if (replay.wrong.empty()) replay.cover(0, 0, 0);
  return replay.wrong;
}

}  // namespace fc::hulls

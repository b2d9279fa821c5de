#include "ch02_hull_hierarchy/box_tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace fc::hulls {
namespace {

// Boxes are kept in single precision; their squares must be, too.
constexpr double kSmallest = 1e-12, kLargest = 1e15;  // m, of a model's reach

using Vec3f = Eigen::Vector3f;

// A box around some points, with the axes that floats can hold.
struct Box {
  Vec3f center, u, v, half;
  float radius;

  double surface() const { return half[0] * half[1] + half[1] * half[2] + half[2] * half[0]; }
};

// The nearest floats. Through memory: GCC 12's vectoriser assumes that a double converted to float and back
// is unchanged.
Vec3f rounded(const Vec3& x) {
  Vec3f result;
  for (int k = 0; k < 3; ++k) {
    volatile float nearest = static_cast<float>(x[k]);
    result[k] = nearest;
  }
  return result;
}

Box box_along(const Mat3& axes, std::span<const Vec3> points, double noise) {
  Box box;
  box.u = rounded(axes.col(0));
  box.v = rounded(axes.col(1));
  Mat3 basis;  // as the floats will be read
  basis << box.u.cast<double>(), box.v.cast<double>(), box.u.cross(box.v).cast<double>();
  const Mat3 coordinates = basis.inverse();
  const auto spread = [&](const Vec3& middle) {
    Eigen::AlignedBox3d range;
    for (const Vec3& p : points) range.extend(coordinates * (p - middle));
    return range;
  };
  box.center = rounded(basis * spread(Vec3::Zero()).center());
  const Vec3 center = box.center.cast<double>();
  const Eigen::AlignedBox3d range = spread(center);
  double radius = 0;
  for (const Vec3& p : points) radius = std::max(radius, (p - center).norm());
  for (int k = 0; k < 3; ++k)
    box.half[k] = float_above(std::max({range.max()[k], -range.min()[k], 0.0}) * (1 + 1e-15) + noise);
  box.radius = float_above(radius * (1 + 1e-15) + noise);
  return box;
}

// Orthonormal axes with the third along w, the first as near to u as can be.
Mat3 axes_from(const Vec3& w, const Vec3& u) {
  Mat3 axes;
  axes.col(2) = w.normalized();
  axes.col(1) = axes.col(2).cross(u).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

struct Builder {
  const FeatureMesh& mesh;
  const std::vector<std::vector<Vec3>>* leaves = nullptr;  // in place of the triangles
  BoxTree tree{};
  std::vector<Vec3> middles{};  // of the triangles
  double noise = 0;             // m, the rounding of a point's coordinates in a box

  std::vector<Vec3> points_of(int begin, int end) const {
    std::vector<Vec3> points;
    if (leaves != nullptr) {
      for (int k = begin; k < end; ++k) {
        const std::vector<Vec3>& leaf = (*leaves)[static_cast<std::size_t>(tree.leaf_item[k])];
        points.insert(points.end(), leaf.begin(), leaf.end());
      }
      return points;
    }
    points.reserve(3 * (end - begin));
    for (int k = begin; k < end; ++k)
      for (const int v : mesh.triangles[tree.leaf_item[k]]) points.push_back(mesh.vertices[v]);
    return points;
  }

  Box fit(int begin, int end, std::span<const Vec3> points) const {
    Box best = box_along(Mat3::Identity(), points, noise);
    const auto consider = [&](const Mat3& axes) {
      if (!axes.allFinite() || !(std::abs(axes.determinant()) > 0.5)) return;
      const Box box = box_along(axes, points, noise);
      if (box.surface() < best.surface()) best = box;
    };
    // The principal axes of the corners.
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
    Mat3 spread = Mat3::Zero();
    for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
    Eigen::SelfAdjointEigenSolver<Mat3> principal;
    principal.computeDirect(spread / std::max(spread.cwiseAbs().maxCoeff(), 1e-300));
    consider(axes_from(principal.eigenvectors().col(0), principal.eigenvectors().col(2)));
    // A few triangles: the axes of each, along its longest side.
    if (leaves == nullptr && end - begin <= kFewTriangles)
      for (int k = begin; k < end; ++k) {
        const int t = tree.leaf_item[k];
        Vec3 longest = Vec3::Zero();
        for (int i = 0; i < 3; ++i) {
          const Vec3 side =
              mesh.vertices[mesh.triangles[t][i]] - mesh.vertices[mesh.triangles[t][(i + 1) % 3]];
          if (side.squaredNorm() > longest.squaredNorm()) longest = side;
        }
        consider(axes_from(mesh.normals[t], longest));
      }
    return best;
  }
  static constexpr int kFewTriangles = 16;

  // Orders the leaves begin ... end - 1 so that the halves lie apart along the box's longest side.
  int split(int begin, int end, const Box& box) {
    Vec3f::Index longest = 0;
    box.half.maxCoeff(&longest);
    const Vec3f axes[3] = {box.u, box.v, box.u.cross(box.v)};
    const Vec3 along = axes[longest].cast<double>();
    const int middle = begin + (end - begin) / 2;
    std::nth_element(tree.leaf_item.begin() + begin, tree.leaf_item.begin() + middle,
                     tree.leaf_item.begin() + end, [&](int i, int j) {
                       const double x = along.dot(middles[i]), y = along.dot(middles[j]);
                       return x != y ? x < y : i < j;
                     });
    return middle;
  }

  static void set(BoxQuad& quad, int lane, const Box& box, int begin, int end) {
    const auto put = [&](Lanes3& lanes, const Vec3f& x) {
      lanes.x[lane] = x[0];
      lanes.y[lane] = x[1];
      lanes.z[lane] = x[2];
    };
    put(quad.center, box.center);
    put(quad.axis[0], box.u);
    put(quad.axis[1], box.v);
    put(quad.half, box.half);
    quad.radius[lane] = box.radius;
    quad.first_leaf[lane] = begin;
    quad.leaf_count[lane] = end - begin;
  }

  // Fills one lane with the leaves begin ... end - 1, and makes the quads below it.
  void node(int quad, int lane, int begin, int end, const Box& box) {
    set(tree.quads[quad], lane, box, begin, end);
    if (end - begin == 1) {
      tree.quads[quad].child[lane] = ~begin;
      return;
    }
    const int below = static_cast<int>(tree.quads.size());
    tree.quads.push_back(empty_quad());
    tree.quads[quad].child[lane] = below;
    struct Part {
      int begin, end;
      Box box;
    };
    const auto halves = [&](const Part& part) {
      const int middle = split(part.begin, part.end, part.box);
      return std::array{Part{part.begin, middle, fit(part.begin, middle, points_of(part.begin, middle))},
                        Part{middle, part.end, fit(middle, part.end, points_of(middle, part.end))}};
    };
    int next = 0;
    for (const Part& half : halves({begin, end, box})) {
      if (half.end - half.begin == 1) {
        node(below, next++, half.begin, half.end, half.box);
        continue;
      }
      for (const Part& quarter : halves(half)) node(below, next++, quarter.begin, quarter.end, quarter.box);
    }
  }

  static BoxQuad empty_quad() {
    BoxQuad quad{};
    for (int lane = 0; lane < 4; ++lane) {
      set(quad, lane, {Vec3f::Zero(), Vec3f::UnitX(), Vec3f::UnitY(), Vec3f::Zero(), 0}, 0, 0);
      quad.child[lane] = 0;
    }
    return quad;
  }
};

}  // namespace

namespace {

void check_reach(double reach) {
  if (reach != 0 && !(reach >= kSmallest && reach <= kLargest))
    throw std::invalid_argument("build_box_tree: the model reaches " + std::to_string(reach) +
                                " m from its centre of mass; it must be 1e-12 m to 1e15 m");
}

}  // namespace

BoxTree build_box_tree(const std::vector<std::vector<Vec3>>& leaves) {
  const FeatureMesh none;
  Builder builder{none, &leaves};
  BoxTree& tree = builder.tree;
  double reach = 0;
  for (const std::vector<Vec3>& leaf : leaves) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : leaf) {
      box.extend(p);
      reach = std::max(reach, p.norm());
    }
    builder.middles.push_back(box.center());
  }
  check_reach(reach);
  builder.noise = 1e-15 * reach;
  const int count = static_cast<int>(leaves.size());
  tree.quads.push_back(Builder::empty_quad());
  tree.leaf_item.resize(leaves.size());
  std::iota(tree.leaf_item.begin(), tree.leaf_item.end(), 0);
  builder.node(0, 0, 0, count, builder.fit(0, count, builder.points_of(0, count)));
  tree.points = builder.points_of(0, count);
  tree.leaf_start = {0};
  for (const int item : tree.leaf_item)
    tree.leaf_start.push_back(tree.leaf_start.back() +
                              static_cast<int>(leaves[static_cast<std::size_t>(item)].size()));
  return std::move(tree);
}

BoxTree build_box_tree(const FeatureMesh& mesh, bool whole) {
  double reach = 0;
  for (const Vec3& p : mesh.vertices) reach = std::max(reach, p.norm());
  check_reach(reach);
  Builder builder{mesh};
  builder.noise = 1e-15 * reach;
  BoxTree& tree = builder.tree;
  tree.quads.push_back(Builder::empty_quad());
  if (whole) {
    tree.leaf_item = {-1};
    tree.points = mesh.vertices;
    tree.leaf_start = {0, static_cast<int>(mesh.vertices.size())};
    builder.node(0, 0, 0, 1, builder.fit(0, 0, mesh.vertices));
    return std::move(tree);
  }
  const int count = static_cast<int>(mesh.triangles.size());
  for (const auto& [i, j, k] : mesh.triangles)
    builder.middles.push_back((mesh.vertices[i] + mesh.vertices[j] + mesh.vertices[k]) / 3);
  tree.leaf_item.resize(count);
  std::iota(tree.leaf_item.begin(), tree.leaf_item.end(), 0);
  tree.quads.reserve(count / 2 + 1);
  builder.node(0, 0, 0, count, builder.fit(0, count, builder.points_of(0, count)));
  for (int k = 0; k <= count; ++k) tree.leaf_start.push_back(3 * k);
  tree.points = builder.points_of(0, count);
  return std::move(tree);
}

}  // namespace fc::hulls

#include "ch06_friction/friction_patches.hpp"

#include <algorithm>
#include <cmath>

#include "ch06_friction/contact_sweeps.hpp"

namespace fc::friction {

using resting::at;

void PatchedGaussSeidel::clear() {
  GaussSeidel::clear();
  patches_.clear();
  members_.clear();
  patch_of_.clear();
  arranged_ = 0;
}

void PatchedGaussSeidel::end_pair(int first, int world_a, int world_b, std::span<const Vec3> guesses) {
  const auto shape = [&](int body) { return world_.bodies[at(body)].shape; };
  const double mu = world_.pair_rules.friction(world_.shapes, shape(world_a), shape(world_b));
  patch_of_.resize(at(rows()), -1);
  if (!(mu > 0)) return;
  Patch patch{};
  patch.a = of_row(first).a;
  patch.b = of_row(first).b;
  patch.mu = static_cast<float>(mu);
  patch.first = static_cast<int>(members_.size());
  patch.end = patch.first + rows() - first;
  const Mass &a = masses_[at(patch.a)], &b = masses_[at(patch.b)];

  // The plane is that of the first row; the other points may lie slightly off it.
  const Vec3 n = patch.normal = sources_[at(first)].normal;
  Vec3 centre = Vec3::Zero(), tangential = Vec3::Zero();
  double weight = 0;
  for (int row = first; row < rows(); ++row) {
    const double normal = std::max(0.0, guesses[at(row - first)].dot(n)) + 1e-30;
    centre += normal * sources_[at(row)].point;
    weight += normal;
    tangential += guesses[at(row - first)] - guesses[at(row - first)].dot(n) * n;
  }
  centre /= weight;
  double twist = 0;
  for (int row = first; row < rows(); ++row) {
    Vec3 arm = sources_[at(row)].point - centre;
    arm -= n.dot(arm) * n;
    twist += n.dot(arm.cross(guesses[at(row - first)]));
    members_.push_back({row, row, 1 / sources_[at(row)].root, static_cast<float>(arm.norm()), arm});
  }

  const Mat3 frame = contact_frame(n);
  for (int k = 0; k < 2; ++k) patch.tangents[k] = frame.col(k + 1);
  Vec3 move_a[2], turn_a[2], move_b[2], turn_b[2];
  for (int k = 0; k < 2; ++k) {
    const Vec3& t = patch.tangents[k];
    patch.arms_a[k] = (centre - a.place).cross(t);
    patch.arms_b[k] = (centre - b.place).cross(t);
    move_a[k] = -a.root.cwiseProduct(t);
    move_b[k] = b.root.cwiseProduct(t);
    turn_a[k] = -(a.turn_root.transpose() * patch.arms_a[k]);
    turn_b[k] = b.turn_root.transpose() * patch.arms_b[k];
  }
  const auto product = [&](int j, int k) {
    return move_a[j].dot(move_a[k]) + turn_a[j].dot(turn_a[k]) + move_b[j].dot(move_b[k]) +
           turn_b[j].dot(turn_b[k]);
  };
  // One factor for both tangents, so that friction opposes the slip: the larger eigenvalue of their block.
  const double p = product(0, 0), q = product(1, 1), r = product(0, 1);
  const double root = std::sqrt(0.5 * (p + q) + std::hypot(0.5 * (p - q), r));
  const Vec3 spin_a = -(a.turn_root.transpose() * n), spin_b = b.turn_root.transpose() * n;
  const double twist_root = std::sqrt(spin_a.squaredNorm() + spin_b.squaredNorm());
  if (!(root > 0)) return;
  patch.root = static_cast<float>(root);
  patch.twist_root = static_cast<float>(twist_root);
  const auto line = [](const Vec3& move, const Vec3& turn, double scale) {
    Vec8 result = Vec8::Zero();
    if (!(scale > 0)) return result;
    result.head<3>() = (move / scale).array().cast<float>();
    result.segment<3>(3) = (turn / scale).array().cast<float>();
    return result;
  };
  const auto start = [&](const std::vector<Twist>& twists, int k) {
    const Twist &u = twists[at(patch.a)], &v = twists[at(patch.b)];
    if (k == 2) return n.dot(v.angular - u.angular);
    return patch.tangents[k].dot(v.linear - u.linear) + patch.arms_b[k].dot(v.angular) -
           patch.arms_a[k].dot(u.angular);
  };
  for (int k = 0; k < 3; ++k) {
    const double scale = k < 2 ? root : twist_root;
    patch.lines[k] = k < 2 ? Line{line(move_a[k], turn_a[k], scale), line(move_b[k], turn_b[k], scale)}
                           : Line{line(Vec3::Zero(), spin_a, scale), line(Vec3::Zero(), spin_b, scale)};
    const double inverse = scale > 0 ? 1 / scale : 0;
    patch.start[k] = static_cast<float>(start(velocities_, k) * inverse);
    patch.path_start[k] = static_cast<float>(start(paths_, k) * inverse);
    const double guess = k < 2 ? tangential.dot(patch.tangents[k]) : twist;
    patch.impulse[k] = static_cast<float>(guess * scale);
    patch.correction[k] = 0.5F * patch.impulse[k];
  }
  for (int row = first; row < rows(); ++row) patch_of_[at(row)] = static_cast<int>(patches_.size());
  patches_.push_back(patch);
}

// Arranges patches like their rows: patches that follow each other share no body.
void PatchedGaussSeidel::rows_arranged() {
  for (Member& member : members_) member.place = place_[at(member.row)];
  std::sort(patches_.begin() + static_cast<std::ptrdiff_t>(arranged_), patches_.end(),
            [&](const Patch& x, const Patch& y) {
              return members_[at(x.first)].place < members_[at(y.first)].place;
            });
  for (; arranged_ < patches_.size(); ++arranged_) {
    const Patch& patch = patches_[arranged_];
    for (int i = patch.first; i < patch.end; ++i)
      patch_of_[at(members_[at(i)].row)] = static_cast<int>(arranged_);
  }
}

// ANCHOR: patch
void PatchedGaussSeidel::sweep(Patch& patch, bool velocities, bool paths) {
  float load = 0, moment = 0, path_load = 0, path_moment = 0;  // N s, N m s
  for (int i = patch.first; i < patch.end; ++i) {
    const Member& member = members_[at(i)];
    const Row& row = rows_[at(member.place)];
    load += row.impulse * member.inverse_root;
    moment += row.impulse * member.inverse_root * member.distance;
    path_load += row.correction * member.inverse_root;
    path_moment += row.correction * member.inverse_root * member.distance;
  }
  State &a = states_[at(patch.a)], &b = states_[at(patch.b)];
  if (velocities) push(patch, load, moment, patch.start, patch.impulse, a.velocity, b.velocity);
  if (paths) push(patch, path_load, path_moment, patch.path_start, patch.correction, a.path, b.path);
}

void PatchedGaussSeidel::push(const Patch& patch, float load, float moment, const float* start,
                              float* impulse, Vec8& of_a, Vec8& of_b) {
  const auto slip = [&](int k) {
    return (patch.lines[k].a * of_a + patch.lines[k].b * of_b).sum() + start[k];
  };
  const float x = impulse[0] - slip(0), y = impulse[1] - slip(1);
  const float limit = patch.mu * load * patch.root, size = std::sqrt(x * x + y * y);
  const float shorter = size > limit ? limit / size : 1.0F;
  const float most = patch.mu * moment * patch.twist_root;
  const float wanted[3] = {x * shorter, y * shorter, std::clamp(impulse[2] - slip(2), -most, most)};
  for (int k = 0; k < 3; ++k) {
    const float change = wanted[k] - impulse[k];
    impulse[k] = wanted[k];
    of_a += change * patch.lines[k].a;
    of_b += change * patch.lines[k].b;
  }
}
// ANCHOR_END: patch

void PatchedGaussSeidel::sweep_more(bool velocities, bool paths) {
  for (Patch& patch : patches_) sweep(patch, velocities, paths);
}

void PatchedGaussSeidel::apply_more_guesses() {
  for (const Patch& patch : patches_) {
    State &a = states_[at(patch.a)], &b = states_[at(patch.b)];
    for (int k = 0; k < 3; ++k) {
      a.velocity += patch.impulse[k] * patch.lines[k].a;
      b.velocity += patch.impulse[k] * patch.lines[k].b;
      a.path += patch.correction[k] * patch.lines[k].a;
      b.path += patch.correction[k] * patch.lines[k].b;
    }
  }
}

// The row's patch has less load to carry.
void PatchedGaussSeidel::row_dropped(int row) {
  if (const int patch = patch_of(row); patch >= 0) sweep(patches_[at(patch)], true, false);
}

void PatchedGaussSeidel::drop_all() {
  for (Patch& patch : patches_) {
    std::fill(std::begin(patch.impulse), std::end(patch.impulse), 0.0F);
    std::fill(std::begin(patch.correction), std::end(patch.correction), 0.0F);
  }
}

void PatchedGaussSeidel::add_gains(double& sum, double& size) const {
  for (const Patch& patch : patches_) {
    const State &a = states_[at(patch.a)], &b = states_[at(patch.b)];
    for (int k = 0; k < 3; ++k) {
      const float now =
          (patch.lines[k].a * a.velocity + patch.lines[k].b * b.velocity).sum() + patch.start[k];
      sum += static_cast<double>(patch.impulse[k]) * static_cast<double>(patch.start[k] + now);
      size += std::abs(static_cast<double>(patch.impulse[k]) * static_cast<double>(patch.start[k]));
    }
  }
}

void PatchedGaussSeidel::add_momenta(bool paths, std::vector<Twist>& momenta) const {
  for (const Patch& patch : patches_) {
    const float* scaled = paths ? patch.correction : patch.impulse;
    for (int k = 0; k < 3; ++k) {
      const float scale = k < 2 ? patch.root : patch.twist_root;
      if (!(scale > 0) || scaled[k] == 0) continue;
      const double z = static_cast<double>(scaled[k]) / static_cast<double>(scale);
      Twist &a = momenta[at(patch.a)], &b = momenta[at(patch.b)];
      if (k < 2) {
        a.linear -= z * patch.tangents[k];
        b.linear += z * patch.tangents[k];
      }
      a.angular -= z * (k < 2 ? patch.arms_a[k] : patch.normal);
      b.angular += z * (k < 2 ? patch.arms_b[k] : patch.normal);
    }
  }
}

Vec3 PatchedGaussSeidel::whole_impulse(int row) const {
  const Vec3 alone = GaussSeidel::whole_impulse(row);
  if (patch_of(row) < 0) return alone;
  const Patch& patch = patches_[at(patch_of_[at(row)])];
  double load = 0, spread = 0;
  Vec3 lever = Vec3::Zero(), arm = Vec3::Zero();
  for (int i = patch.first; i < patch.end; ++i) {
    const Member& member = members_[at(i)];
    const double normal = impulse(member.row);
    load += normal;
    lever += normal * member.arm;
    spread += normal * member.arm.squaredNorm();
    if (member.row == row) arm = member.arm;
  }
  if (!(load > 0)) return alone;
  const double root = static_cast<double>(patch.root), twist_root = static_cast<double>(patch.twist_root);
  const Vec3 whole = static_cast<double>(patch.impulse[0]) / root * patch.tangents[0] +
                     static_cast<double>(patch.impulse[1]) / root * patch.tangents[1];
  const double twist = twist_root > 0 ? static_cast<double>(patch.impulse[2]) / twist_root : 0;
  // About the centre of the shares, arms and moments are those of the shares; the whole impulse acts there.
  const Vec3 centre = lever / load;
  const double about = twist - patch.normal.dot(centre.cross(whole));
  const double inertia = spread - load * centre.squaredNorm();
  Vec3 share = impulse(row) / load * whole;
  if (inertia > 1e-12 * spread) share += impulse(row) * about / inertia * patch.normal.cross(arm - centre);
  return alone + share;
}

}  // namespace fc::friction

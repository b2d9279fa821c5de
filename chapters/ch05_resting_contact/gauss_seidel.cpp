#include "ch05_resting_contact/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>

namespace fc::resting {
namespace {

constexpr float kNever = 1e30F;  // what a dropped row allows

// L with L L' = the inverse inertia; of a body that may not turn about all of its axes it is found in these, where the fixed ones
// stand apart.
Mat3 root_of(const RigidBody& body, const Mat3& inverse_inertia) {
  if (body.free_turns == Vec3::Ones()) return inverse_inertia.llt().matrixL();
  const Mat3 free = body.free_turns.asDiagonal(), fixed = (Vec3::Ones() - body.free_turns).asDiagonal();
  const Mat3 lower = (body.inverse_inertia_body + fixed).llt().matrixL();
  return body.orientation.toRotationMatrix() * lower * free;
}

double along(const Vec3& normal, const Vec3& arm_a, const Vec3& arm_b, const Twist& a, const Twist& b) {
  return normal.dot(b.linear - a.linear) + arm_b.dot(b.angular) - arm_a.dot(a.angular);
}

}  // namespace

void GaussSeidel::clear() {
  rows_.clear();
  lines_.clear();
  arms_.clear();
  points_.clear();
  masses_.clear();
  velocities_.clear();
  paths_.clear();
  states_.clear();
}

void GaussSeidel::add_body(const RigidBody& body, const Twist& velocity, const Twist& path) {
  Mass mass{body.position, body.inverse_mass * body.free_moves,
            std::sqrt(body.inverse_mass) * body.free_moves, Mat3::Zero(), Mat3::Zero()};
  if (!body.is_static()) {
    mass.turn = body.inverse_inertia_world();
    mass.turn_root = root_of(body, mass.turn);
  }
  masses_.push_back(mass);
  velocities_.push_back(velocity);
  paths_.push_back(path);
  states_.push_back({Vec8::Zero(), Vec8::Zero()});
}

int GaussSeidel::add(const lcp::Contact& c, double approach_limit, double room, double impulse,
                     double correction) {
  const Mass &a = masses_[at(c.body_a)], &b = masses_[at(c.body_b)];
  Arms arms{c.normal, Vec3::Zero(), Vec3::Zero()};
  if (c.turns_a) arms.a = (c.point - a.place).cross(c.normal);
  if (c.turns_b) arms.b = (c.point - b.place).cross(c.normal);
  const Vec3 move_a = -a.root.cwiseProduct(c.normal), turn_a = -(a.turn_root.transpose() * arms.a);
  const Vec3 move_b = b.root.cwiseProduct(c.normal), turn_b = b.turn_root.transpose() * arms.b;
  const double root =
      std::sqrt(move_a.squaredNorm() + turn_a.squaredNorm() + move_b.squaredNorm() + turn_b.squaredNorm());
  const auto end = [&](const Vec3& move, const Vec3& turn) {
    Vec8 line = Vec8::Zero();
    line.head<3>() = (move / root).array().cast<float>();
    line.segment<3>(3) = (turn / root).array().cast<float>();
    return line;
  };
  const auto start = [&](const std::vector<Twist>& twists) {
    return along(c.normal, arms.a, arms.b, twists[at(c.body_a)], twists[at(c.body_b)]);
  };
  const double path_start = start(paths_);
  rows_.push_back({c.body_a, c.body_b, static_cast<float>(impulse * root),
                   static_cast<float>(correction * root),
                   static_cast<float>((start(velocities_) + approach_limit) / root),
                   static_cast<float>((path_start + room) / root), static_cast<float>(root),
                   static_cast<float>(path_start / root)});
  lines_.push_back({end(move_a, turn_a), end(move_b, turn_b)});
  arms_.push_back(arms);
  points_.push_back(c.point);
  return rows() - 1;
}

void GaussSeidel::end_pair(int, int, int, std::span<const Vec3>) {}

// ANCHOR: sweep
template <bool kVelocities, bool kPaths>
void GaussSeidel::sweep() {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    Row& row = rows_[r];
    const Line& line = lines_[r];
    State &a = states_[at(row.a)], &b = states_[at(row.b)];
    if constexpr (kVelocities) {
      const float w = (line.a * a.velocity + line.b * b.velocity).sum() + row.approach_limit;
      const float push = std::max(-row.impulse, -w);
      row.impulse += push;
      a.velocity += push * line.a;
      b.velocity += push * line.b;
    }
    if constexpr (kPaths) {
      const float u = (line.a * a.path + line.b * b.path).sum() + row.room;
      const float push = std::max(-row.correction, -u);
      row.correction += push;
      a.path += push * line.a;
      b.path += push * line.b;
    }
  }
  sweep_more(kVelocities, kPaths);
}
// ANCHOR_END: sweep

void GaussSeidel::apply_guesses() {
  for (State& state : states_) state = {Vec8::Zero(), Vec8::Zero()};
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    State &a = states_[at(row.a)], &b = states_[at(row.b)];
    a.velocity += row.impulse * lines_[r].a;
    b.velocity += row.impulse * lines_[r].b;
    a.path += row.correction * lines_[r].a;
    b.path += row.correction * lines_[r].b;
  }
  apply_more_guesses();
}

// Impulses change the kinetic energy by z'J v_0 + z'A z / 2 <= z'(b + w) / 2, since z'approach_limit >= 0. Each step of a sweep
// lowers that, so it is <= 0 but for guesses.
bool GaussSeidel::gains() const {
  double sum = 0, size = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    if (!(row.impulse > 0)) continue;
    const State &a = states_[at(row.a)], &b = states_[at(row.b)];
    const float w = (lines_[r].a * a.velocity + lines_[r].b * b.velocity).sum() + row.approach_limit;
    sum += static_cast<double>(row.impulse) * static_cast<double>(row.approach_limit + w);
    size += static_cast<double>(row.impulse) * static_cast<double>(std::abs(row.approach_limit));
  }
  add_gains(sum, size);
  constexpr double kRounding = 1e-6;  // of single precision
  return sum > kRounding * size;
}

template <bool kVelocities, bool kPaths>
int GaussSeidel::run(int sweeps) {
  constexpr int kMore = 4, kMostTimes = 5;
  int count = 0;
  const auto go_on = [&](int more) {
    for (int k = 0; k < more; ++k) sweep<kVelocities, kPaths>();
    count += more;
  };
  if (kVelocities && kPaths) apply_guesses();
  go_on(sweeps);
  if (!kVelocities) return count;
  for (int times = 0; times < kMostTimes && gains(); ++times) go_on(kMore);
  if (!gains()) return count;
  for (Row& row : rows_) {
    row.impulse = 0;
    if (kPaths) row.correction = 0;
  }
  drop_all();
  apply_guesses();
  go_on(sweeps);
  return count;
}

template int GaussSeidel::run<true, true>(int);
template int GaussSeidel::run<true, false>(int);
template int GaussSeidel::run<false, true>(int);

void GaussSeidel::set_room(int row, double room) {
  Row& r = rows_[at(row)];
  r.room = r.path_start + static_cast<float>(room) / r.root;
}

void GaussSeidel::drop(int row) {
  Row& r = rows_[at(row)];
  states_[at(r.a)].velocity -= r.impulse * lines_[at(row)].a;
  states_[at(r.b)].velocity -= r.impulse * lines_[at(row)].b;
  r.impulse = 0;
  r.approach_limit = kNever;
  row_dropped(row);
}

double GaussSeidel::start_speed(int row) const {
  const Arms& arms = arms_[at(row)];
  return along(arms.normal, arms.a, arms.b, velocities_[at(of_row(row).a)], velocities_[at(of_row(row).b)]);
}

double GaussSeidel::path_speed(int row) const {
  const Row& r = rows_[at(row)];
  const Line& line = lines_[at(row)];
  return static_cast<double>(
      ((line.a * states_[at(r.a)].path + line.b * states_[at(r.b)].path).sum() + r.path_start) * r.root);
}

void GaussSeidel::work_out(std::vector<Twist>& velocities, std::vector<Twist>& paths) const {
  std::vector<Twist>* const results[] = {&velocities, &paths};
  for (const bool is_path : {false, true}) {
    std::vector<Twist>& result = *results[is_path];
    result.assign(masses_.size(), {});  // first the impulses of each body, N s and N m s
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      const Row& row = rows_[r];
      const float scaled = is_path ? row.correction : row.impulse;
      if (!(scaled > 0)) continue;
      const double z = static_cast<double>(scaled) / static_cast<double>(row.root);
      result[at(row.a)].linear -= z * arms_[r].normal;
      result[at(row.a)].angular -= z * arms_[r].a;
      result[at(row.b)].linear += z * arms_[r].normal;
      result[at(row.b)].angular += z * arms_[r].b;
    }
    add_momenta(is_path, result);
    for (std::size_t k = 0; k < masses_.size(); ++k) {
      const Twist& start = is_path ? paths_[k] : velocities_[k];
      result[k] = {start.linear + masses_[k].move.cwiseProduct(result[k].linear),
                   start.angular + masses_[k].turn * result[k].angular};
    }
  }
}

double GaussSeidel::residual() const {
  float worst = 0, largest = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    const float w =
        (lines_[r].a * states_[at(row.a)].velocity + lines_[r].b * states_[at(row.b)].velocity).sum() +
        row.approach_limit;
    if (row.approach_limit < kNever) largest = std::max(largest, std::abs(row.approach_limit));
    worst = std::max(worst, std::abs(std::min(row.impulse, w)));
  }
  return largest > 0 ? static_cast<double>(worst / largest) : 0;
}

}  // namespace fc::resting

#include "ch05_resting_contact/gauss_seidel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fc::resting {
namespace {

constexpr float kNever = 1e30F;  // the approach that a dropped row allows

// L with L L' = the inverse inertia. For a body that may not turn about all of its axes it is found in these axes,
// where the fixed ones stand apart.
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
  place_.clear();
  sources_.clear();
  arranged_ = 0;
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
  Source source{c.normal, Vec3::Zero(), Vec3::Zero(), c.point, 0, 0, 0};
  if (c.turns_a) source.arm_a = (c.point - a.place).cross(c.normal);
  if (c.turns_b) source.arm_b = (c.point - b.place).cross(c.normal);
  const Vec3 move_a = -a.root.cwiseProduct(c.normal), turn_a = -(a.turn_root.transpose() * source.arm_a);
  const Vec3 move_b = b.root.cwiseProduct(c.normal), turn_b = b.turn_root.transpose() * source.arm_b;
  const double root =
      std::sqrt(move_a.squaredNorm() + turn_a.squaredNorm() + move_b.squaredNorm() + turn_b.squaredNorm());
  const double inverse = 1 / root;
  const auto line = [&](const Vec3& move, const Vec3& turn) {
    Vec8 result = Vec8::Zero();
    result.head<3>() = (inverse * move).array().cast<float>();
    result.segment<3>(3) = (inverse * turn).array().cast<float>();
    return result;
  };
  const auto start = [&](const std::vector<Twist>& twists) {
    return along(c.normal, source.arm_a, source.arm_b, twists[at(c.body_a)], twists[at(c.body_b)]);
  };
  const double path_start = start(paths_);
  source.root = static_cast<float>(root);
  source.path_start = static_cast<float>(inverse * path_start);
  source.start = start(velocities_);
  place_.push_back(rows());
  sources_.push_back(source);
  rows_.push_back({line(move_a, turn_a), line(move_b, turn_b), c.body_a, c.body_b,
                   static_cast<float>(impulse * root), static_cast<float>(correction * root),
                   static_cast<float>(inverse * (source.start + approach_limit)),
                   static_cast<float>(inverse * (path_start + room))});
  return rows() - 1;
}

void GaussSeidel::end_pair(int, int, int, std::span<const Vec3>) {}

// ANCHOR: sweep
template <bool kVelocities, bool kPaths>
void GaussSeidel::sweep() {
  for (Row& row : rows_) {
    State &a = states_[at(row.a)], &b = states_[at(row.b)];
    if constexpr (kVelocities) {
      const float w = (row.line_a * a.velocity + row.line_b * b.velocity).sum() + row.approach_limit;
      const float push = std::max(-row.impulse, -w);
      row.impulse += push;
      a.velocity += push * row.line_a;
      b.velocity += push * row.line_b;
    }
    if constexpr (kPaths) {
      const float u = (row.line_a * a.path + row.line_b * b.path).sum() + row.room;
      const float push = std::max(-row.correction, -u);
      row.correction += push;
      a.path += push * row.line_a;
      b.path += push * row.line_b;
    }
  }
  sweep_more(kVelocities, kPaths);
}
// ANCHOR_END: sweep

// Gives places to the rows that were added since the last call. A row has to wait for the one before it if both move
// the same body, and neighbours in the list do: pairs come body by body. So a long list is taken in eight parts, and
// eight pairs go in step, one from each part: the first row of each, then the second of each. Then the processor works
// on several at once. Within each part pairs keep their order, so a row sees in the same sweep what the one before it
// has changed.
void GaussSeidel::arrange() {
  constexpr int kInStep = 8, kLeastPart = 64;
  if (arranged_ == rows()) return;
  pairs_.clear();
  for (int number = arranged_; number < rows(); ++number) {
    const bool same = number > arranged_ && rows_[at(number)].a == rows_[at(number - 1)].a &&
                      rows_[at(number)].b == rows_[at(number - 1)].b;
    if (same)
      ++pairs_.back().count;
    else
      pairs_.push_back({number, 1});
  }
  added_.assign(rows_.begin() + arranged_, rows_.end());
  const int offset = arranged_, count = static_cast<int>(pairs_.size()),
            part = std::max((count + kInStep - 1) / kInStep, std::min(count, kLeastPart));
  for (int i = 0; i < part; ++i) {
    bool any = true;
    for (int k = 0; std::exchange(any, false); ++k)
      for (int j = i; j < count; j += part) {
        if (k >= pairs_[at(j)].count) continue;
        any = true;
        const int number = pairs_[at(j)].first + k;
        place_[at(number)] = arranged_;
        rows_[at(arranged_++)] = added_[at(number - offset)];
      }
  }
  rows_arranged();
}

void GaussSeidel::apply_guesses() {
  for (State& state : states_) state = {Vec8::Zero(), Vec8::Zero()};
  for (const Row& row : rows_) {
    State &a = states_[at(row.a)], &b = states_[at(row.b)];
    a.velocity += row.impulse * row.line_a;
    b.velocity += row.impulse * row.line_b;
    a.path += row.correction * row.line_a;
    b.path += row.correction * row.line_b;
  }
  apply_more_guesses();
}

// Impulses change the kinetic energy by z'J v_0 + z'A z / 2 <= z'(b + w) / 2, since z'approach_limit >= 0. Each step of
// a sweep lowers that, so it is <= 0 unless the guesses were bad.
bool GaussSeidel::gains() const {
  double sum = 0, size = 0;
  for (const Row& row : rows_) {
    if (!(row.impulse > 0)) continue;
    const float w = speed(row) + row.approach_limit;
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
  arrange();
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
  const Source& source = sources_[at(row)];
  of_row(row).room = source.path_start + static_cast<float>(room) / source.root;
}

void GaussSeidel::drop(int row) {
  Row& r = of_row(row);
  states_[at(r.a)].velocity -= r.impulse * r.line_a;
  states_[at(r.b)].velocity -= r.impulse * r.line_b;
  r.impulse = 0;
  r.approach_limit = kNever;
  row_dropped(row);
}

double GaussSeidel::path_speed(int row) const {
  const Row& r = of_row(row);
  const Source& source = sources_[at(row)];
  const float u = (r.line_a * states_[at(r.a)].path + r.line_b * states_[at(r.b)].path).sum();
  return static_cast<double>((u + source.path_start) * source.root);
}

void GaussSeidel::work_out(bool paths, std::vector<Twist>& result) const {
  result.assign(masses_.size(), {});  // at first the impulses on each body, N s and N m s
  for (int number = 0; number < rows(); ++number) {
    const Row& row = of_row(number);
    const float scaled = paths ? row.correction : row.impulse;
    if (!(scaled > 0)) continue;
    const Source& source = sources_[at(number)];
    const double z = static_cast<double>(scaled) / static_cast<double>(source.root);
    Twist &a = result[at(row.a)], &b = result[at(row.b)];
    a.linear -= z * source.normal;
    a.angular -= z * source.arm_a;
    b.linear += z * source.normal;
    b.angular += z * source.arm_b;
  }
  add_momenta(paths, result);
  for (std::size_t k = 0; k < masses_.size(); ++k) {
    const Twist& start = paths ? paths_[k] : velocities_[k];
    result[k] = {start.linear + masses_[k].move.cwiseProduct(result[k].linear),
                 start.angular + masses_[k].turn * result[k].angular};
  }
}

double GaussSeidel::residual() const {
  float worst = 0, largest = 0;
  for (const Row& row : rows_) {
    if (row.approach_limit < kNever) largest = std::max(largest, std::abs(row.approach_limit));
    worst = std::max(worst, std::abs(std::min(row.impulse, speed(row) + row.approach_limit)));
  }
  return largest > 0 ? static_cast<double>(worst / largest) : 0;
}

}  // namespace fc::resting

#include "ch05_resting_contact/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fc::resting {
namespace {

constexpr int kAllRowsEvery = 16;  // sweeps
constexpr int kPlainSweeps = 3;    // at the end, without conjugate directions

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

void Crowd::begin(std::span<const RigidBody> bodies, std::span<const double> reaches) {
  reaches_.assign(reaches.begin(), reaches.end());
  rows_.clear();
  turns_.clear();
  inverse_masses_.clear();
  places_.clear();
  velocities_.clear();
  for (const RigidBody& body : bodies) {
    inverse_masses_.push_back(body.inverse_mass);
    turns_.push_back(body.is_static() ? Mat3(Mat3::Zero()) : body.inverse_inertia_world());
    places_.push_back(body.position);
    velocities_.push_back({body.velocity, body.spin});
  }
  displacements_.assign(bodies.size(), {});
  is_touched_.assign(bodies.size(), 0);
  touched_.clear();
  start_of_.clear();
  solved_ = false;
}

void Crowd::touch(int body) {
  if (is_touched_[at(body)] || inverse_masses_[at(body)] == 0) return;
  is_touched_[at(body)] = 1;
  touched_.push_back(body);
}

int Crowd::add(const lcp::Contact& c, double allowed, double impulse) {
  Row row;
  row.a = c.body_a;
  row.b = c.body_b;
  row.normal = c.normal;
  row.arm_a = c.turns_a ? Vec3((c.point - places_[at(c.body_a)]).cross(c.normal)) : Vec3(Vec3::Zero());
  row.arm_b = c.turns_b ? Vec3((c.point - places_[at(c.body_b)]).cross(c.normal)) : Vec3(Vec3::Zero());
  row.turn_a = turns_[at(c.body_a)] * row.arm_a;
  row.turn_b = turns_[at(c.body_b)] * row.arm_b;
  row.inverse_a = inverse_masses_[at(c.body_a)];
  row.inverse_b = inverse_masses_[at(c.body_b)];
  row.diagonal = row.inverse_a + row.inverse_b + row.arm_a.dot(row.turn_a) + row.arm_b.dot(row.turn_b);
  row.inverse_diagonal = 1 / row.diagonal;
  row.allowed = allowed;
  row.impulse = impulse;
  row.before = row.room = row.push = 0;
  rows_.push_back(row);
  if (solved_ && impulse > 0) apply(row, impulse, velocities_);
  start_of_.clear();
  return rows() - 1;
}

void Crowd::remove(int number) {
  Row& row = rows_[at(number)];
  apply(row, -row.impulse, velocities_);
  apply(row, -row.push, displacements_);
  for (const int body : {row.a, row.b})
    if (row.impulse != 0 || row.push != 0) touch(body);
  row.impulse = row.push = 0;
  row.a = row.b = -1;
  start_of_.clear();
}

double Crowd::along(const Row& row, const std::vector<Twist>& twists) {
  const Twist &a = twists[at(row.a)], &b = twists[at(row.b)];
  return row.normal.dot(b.linear - a.linear) + row.arm_b.dot(b.angular) - row.arm_a.dot(a.angular);
}

void Crowd::apply(const Row& row, double by, std::vector<Twist>& twists) {
  Twist &a = twists[at(row.a)], &b = twists[at(row.b)];
  a.linear -= (by * row.inverse_a) * row.normal;
  a.angular -= by * row.turn_a;
  b.linear += (by * row.inverse_b) * row.normal;
  b.angular += by * row.turn_b;
}

double Crowd::residual() const {
  double worst = 0;
  for (const Row& row : rows_)
    if (row.a >= 0)
      worst = std::max(worst,
                       std::abs(std::min(row.diagonal * row.impulse, along(row, velocities_) + row.allowed)));
  return scale_ > 0 ? worst / scale_ : 0;
}

double Crowd::solve(const CrowdOptions& options, int& sweeps) {
  // The guess z, times s: s z'b + s^2 z'Az/2 is the least for s = -z'b / z'Az.
  scale_ = 0;
  double along_b = 0, size = 0;
  for (const Row& row : rows_) {
    const double b = along(row, velocities_) + row.allowed;
    scale_ = std::max(scale_, std::abs(b));
    along_b += row.impulse * b;
  }
  std::vector<Twist>& guess = displacements_;  // not in use yet
  for (const Row& row : rows_)
    if (row.impulse > 0) apply(row, row.impulse, guess);
  for (const Row& row : rows_) size += row.impulse * along(row, guess);
  const double share = size > 0 ? std::clamp(-along_b / size, 0.0, 1.0) : 0;
  for (std::size_t k = 0; k < velocities_.size(); ++k) {
    velocities_[k].linear += share * guess[k].linear;
    velocities_[k].angular += share * guess[k].angular;
    guess[k] = {};
  }
  for (Row& row : rows_) row.impulse *= share;

  // Most rows push nothing and will not: between sweeps over all of them, only those that may.
  const double near = options.near * scale_;
  direction_.assign(rows_.size(), 0);
  direction_twists_.assign(velocities_.size(), {});
  double last = 0;
  for (int sweep = 0; sweep < options.most_sweeps; ++sweep) {
    ++sweeps;
    double worst = 0, changed = 0;  // what each row lacked when its turn came; the sum of squares, weighted
    before_ = velocities_;
    const auto visit = [&](int r) {
      Row& row = rows_[at(r)];
      row.before = row.impulse;
      const double w = along(row, velocities_) + row.allowed;
      const double by = std::max(-row.impulse, -w * row.inverse_diagonal);
      if (by == 0) return w < near;
      apply(row, by, velocities_);
      row.impulse += by;
      worst = std::max(worst, row.diagonal * std::abs(by));
      changed += row.diagonal * by * by;
      return true;
    };
    const bool all = sweep % kAllRowsEvery == 0;
    if (all) {
      waiting_.clear();
      for (int r = 0; r < rows(); ++r)
        if (visit(r)) waiting_.push_back(r);
    } else {
      for (const int r : waiting_) visit(r);
    }
    if (worst <= options.residual * scale_) break;
    if (sweep + kPlainSweeps >= options.most_sweeps) continue;
    // What a sweep changes is the gradient of conjugate gradients (Silcowitz, Niebe, Erleben 2010): the last
    // direction is gone on with as far as Fletcher and Reeves say, or forgotten where that does not help.
    double go_on = last > 0 ? changed / last : 0;
    last = changed;
    if (go_on > 1 || all) {  // where that does not help, and with other rows: anew
      std::fill(direction_.begin(), direction_.end(), 0.0);
      std::fill(direction_twists_.begin(), direction_twists_.end(), Twist{});
      go_on = 0;
    }
    for (const int r : waiting_) {
      Row& row = rows_[at(r)];
      double& direction = direction_[at(r)];
      const double step = row.impulse - row.before;
      row.impulse += go_on * direction;
      direction = go_on * direction + step;
    }
    for (std::size_t k = 0; k < velocities_.size(); ++k) {
      Twist& direction = direction_twists_[k];
      const Vec3 linear = velocities_[k].linear - before_[k].linear,
                 angular = velocities_[k].angular - before_[k].angular;
      velocities_[k].linear += go_on * direction.linear;
      velocities_[k].angular += go_on * direction.angular;
      direction.linear = go_on * direction.linear + linear;
      direction.angular = go_on * direction.angular + angular;
    }
  }
  waiting_.clear();
  solved_ = true;
  return residual();
}

void Crowd::join_rows() {
  if (!start_of_.empty()) return;
  start_of_.assign(velocities_.size() + 1, 0);
  for (const Row& row : rows_) {
    if (row.a < 0) continue;
    ++start_of_[at(row.a) + 1];
    ++start_of_[at(row.b) + 1];
  }
  for (std::size_t i = 1; i < start_of_.size(); ++i) start_of_[i] += start_of_[i - 1];
  row_of_.resize(at(start_of_.back()));
  std::vector<int> next(start_of_.begin(), start_of_.end() - 1);
  for (int r = 0; r < rows(); ++r) {
    if (rows_[at(r)].a < 0) continue;
    for (const int body : {rows_[at(r)].a, rows_[at(r)].b}) row_of_[at(next[at(body)]++)] = r;
  }
}

template <bool kVelocity>
void Crowd::spread(const CrowdOptions& options, int& sweeps) {
  std::vector<Twist>& twists = kVelocity ? velocities_ : displacements_;
  const auto way = [&](int body) {
    const Twist& twist = twists[at(body)];
    return twist.linear.norm() + reaches_[at(body)] * twist.angular.norm();
  };
  unsaid_.assign(twists.size(), 0);
  for (int pass = 0; pass < options.most_passes && !waiting_.empty(); ++pass) {
    ++sweeps;
    next_.clear();
    for (const int r : waiting_) is_waiting_[at(r)] = 0;
    for (const int r : waiting_) {
      Row& row = rows_[at(r)];
      double& impulse = kVelocity ? row.impulse : row.push;
      const double w = along(row, twists) + (kVelocity ? row.allowed : row.room);
      const double by = std::max(-impulse, -w * row.inverse_diagonal);
      if (by == 0) continue;
      // Where rows contradict each other, displacements would grow from pass to pass.
      if (!kVelocity && by > 0 && std::max(way(row.a), way(row.b)) > options.farthest) continue;
      apply(row, by, twists);
      impulse += by;
      for (const int body : {row.a, row.b}) {
        if (inverse_masses_[at(body)] == 0) continue;
        touch(body);
        double& unsaid = unsaid_[at(body)];  // what its other rows have not heard of yet
        unsaid += row.diagonal * std::abs(by);
        if (unsaid <= options.enough) continue;
        unsaid = 0;
        for (int k = start_of_[at(body)]; k < start_of_[at(body) + 1]; ++k) {
          const int other = row_of_[at(k)];
          if (other == r || is_waiting_[at(other)]) continue;
          is_waiting_[at(other)] = 1;
          next_.push_back(other);
        }
      }
    }
    waiting_.swap(next_);
  }
  for (const int r : waiting_) is_waiting_[at(r)] = 0;
  waiting_.clear();
}

void Crowd::relax(std::span<const int> from, const CrowdOptions& options, int& sweeps) {
  join_rows();
  is_waiting_.assign(rows_.size(), 0);
  waiting_.assign(from.begin(), from.end());
  for (const int body : touched_)
    waiting_.insert(waiting_.end(), row_of_.begin() + start_of_[at(body)],
                    row_of_.begin() + start_of_[at(body) + 1]);
  spread<true>(options, sweeps);
}

void Crowd::displace(std::span<const double> slack, const CrowdOptions& options, int& sweeps) {
  join_rows();
  is_waiting_.assign(rows_.size(), 0);
  waiting_.clear();
  for (int r = 0; r < rows(); ++r) {
    Row& row = rows_[at(r)];
    if (row.a < 0) continue;
    row.room = slack[at(r)] - along(row, displacements_);
    if (slack[at(r)] < 0) waiting_.push_back(r);
  }
  spread<false>(options, sweeps);
}

void Crowd::forget_displacements() {
  for (Twist& twist : displacements_) twist = {};
  for (Row& row : rows_) row.push = 0;
}

std::vector<int> Crowd::take_touched() {
  for (const int body : touched_) is_touched_[at(body)] = 0;
  return std::exchange(touched_, {});
}

}  // namespace fc::resting

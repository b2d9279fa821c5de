#include "ch05_resting_contact/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fc::resting {
namespace {

constexpr int kAllRowsEvery = 16;  // sweeps
constexpr int kPlainSweeps = 3;    // at the end, without conjugate directions

}  // namespace

// L with L L' = the inverse inertia; of a body that may not turn about all of its axes it is found in these,
// where the fixed ones stand apart.
Mat3 root_of(const RigidBody& body, const Mat3& inverse_inertia) {
  if (body.free_turns == Vec3::Ones()) return inverse_inertia.llt().matrixL();
  const Mat3 free = body.free_turns.asDiagonal(), fixed = (Vec3::Ones() - body.free_turns).asDiagonal();
  const Mat3 lower = (body.inverse_inertia_body + fixed).llt().matrixL();
  return body.orientation.toRotationMatrix() * lower * free;
}

template <class Real>
void Rows<Real>::begin(std::span<const RigidBody> bodies, std::span<const double> reaches) {
  rows_.clear();
  lines_.clear();
  arms_.clear();
  masses_.clear();
  places_.clear();
  starts_.clear();
  for (const RigidBody& body : bodies) {
    Mass mass{body.inverse_mass,
              body.inverse_mass * body.free_moves,
              std::sqrt(body.inverse_mass) * body.free_moves,
              0,
              Mat3::Zero(),
              Mat3::Zero()};
    if (!body.is_static()) {
      mass.turn = body.inverse_inertia_world();
      mass.turn_root = root_of(body, mass.turn);
      const double reach = reaches.empty() ? 0 : reaches[masses_.size()];
      mass.reach = static_cast<Real>(std::max(body.inverse_mass, reach * reach * mass.turn.norm()));
    }
    masses_.push_back(mass);
    places_.push_back(body.position);
    starts_.push_back({body.velocity, body.spin});
  }
  velocities_ = starts_;
  changes_.assign(bodies.size(), Vec8::Zero());
  displacements_.assign(bodies.size(), Vec8::Zero());
  is_touched_.assign(bodies.size(), 0);
  touched_.clear();
  start_of_.clear();
}

template <class Real>
void Rows<Real>::touch(int body) {
  if (is_touched_[at(body)] || masses_[at(body)].inverse == 0) return;
  is_touched_[at(body)] = 1;
  touched_.push_back(body);
}

template <class Real>
int Rows<Real>::add(const lcp::Contact& c, double allowed, double impulse) {
  Arms arms{c.normal, Vec3::Zero(), Vec3::Zero(), allowed};
  if (c.turns_a) arms.a = (c.point - places_[at(c.body_a)]).cross(c.normal);
  if (c.turns_b) arms.b = (c.point - places_[at(c.body_b)]).cross(c.normal);
  const Mass &a = masses_[at(c.body_a)], &b = masses_[at(c.body_b)];
  const Twist &start_a = starts_[at(c.body_a)], &start_b = starts_[at(c.body_b)];
  Eigen::Matrix<double, 6, 1> end_a, end_b;
  end_a << -a.root.cwiseProduct(c.normal), -(a.turn_root.transpose() * arms.a);
  end_b << b.root.cwiseProduct(c.normal), b.turn_root.transpose() * arms.b;
  const double root = std::sqrt(end_a.squaredNorm() + end_b.squaredNorm());
  Line line{Vec8::Zero(), Vec8::Zero()};
  line.a.template head<6>() = (end_a / root).template cast<Real>();
  line.b.template head<6>() = (end_b / root).template cast<Real>();
  const double closing = c.normal.dot(start_b.linear - start_a.linear) + arms.b.dot(start_b.angular) -
                         arms.a.dot(start_a.angular);
  Row row{};
  row.a = c.body_a;
  row.b = c.body_b;
  row.root = static_cast<Real>(root);
  row.allowed = static_cast<Real>((closing + allowed) / root);
  row.impulse = static_cast<Real>(impulse * root);
  rows_.push_back(row);
  lines_.push_back(line);
  arms_.push_back(arms);
  start_of_.clear();
  return rows() - 1;
}

template <class Real>
double Rows<Real>::speed(int number) const {
  const Arms& arms = arms_[at(number)];
  const Twist &a = velocities_[at(rows_[at(number)].a)], &b = velocities_[at(rows_[at(number)].b)];
  return arms.normal.dot(b.linear - a.linear) + arms.b.dot(b.angular) - arms.a.dot(a.angular);
}

template <class Real>
double Rows<Real>::residual() const {
  double worst = 0;
  for (int r = 0; r < rows(); ++r) {
    const double push = static_cast<double>(rows_[at(r)].impulse * rows_[at(r)].root);
    worst = std::max(worst, std::abs(std::min(push, speed(r) + arms_[at(r)].allowed)));
  }
  return scale_ > 0 ? worst / scale_ : 0;
}

// The body's velocity, exactly as its impulses make it.
template <class Real>
void Rows<Real>::work_out(int body) {
  Vec3 push = Vec3::Zero(), turn = Vec3::Zero();
  rows_of(body, [&](int r) {
    const double z = impulse(r);
    if (z == 0) return;
    const Arms& arms = arms_[at(r)];
    const bool is_a = rows_[at(r)].a == body;
    push += (is_a ? -z : z) * arms.normal;
    turn += is_a ? Vec3(-z * arms.a) : Vec3(z * arms.b);
  });
  const Mass& mass = masses_[at(body)];
  velocities_[at(body)].linear = starts_[at(body)].linear + mass.move.cwiseProduct(push);
  velocities_[at(body)].angular = starts_[at(body)].angular + mass.turn * turn;
}

template <class Real>
double Rows<Real>::solve(const CrowdOptions& options, int& sweeps) {
  // The guess z, times s: s z'b + s^2 z'Az/2 is the least for s = -z'b / z'Az.
  scale_ = 0;
  double along_b = 0, size = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const Row& row = rows_[r];
    scale_ = std::max(scale_, static_cast<double>(std::abs(row.allowed) * row.root));
    if (!(row.impulse > 0)) continue;
    along_b += static_cast<double>(row.impulse * row.allowed);
    apply(lines_[r], row, row.impulse, changes_);
  }
  for (const Vec8& change : changes_) size += static_cast<double>(change.squaredNorm());
  const auto share = static_cast<Real>(size > 0 ? std::clamp(-along_b / size, 0.0, 1.0) : 0);
  for (Vec8& change : changes_) change *= share;
  for (Row& row : rows_) row.impulse *= share;

  // Most rows push nothing and will not: between sweeps over all of them, only those that may.
  const auto near = static_cast<Real>(options.near * scale_);
  const auto done = static_cast<Real>(options.residual * scale_);
  row_direction_.assign(rows_.size(), 0);
  direction_.assign(changes_.size(), Vec8::Zero());
  Real last = 0;
  for (int sweep = 0; sweep < options.most_sweeps; ++sweep) {
    ++sweeps;
    Real worst = 0, changed = 0;  // what each row lacked when its turn came; the sum of squares, weighted
    before_ = changes_;
    const auto visit = [&](int r) {
      Row& row = rows_[at(r)];
      const Line& line = lines_[at(r)];
      row.before = row.impulse;
      const Real w = along(line, row, changes_) + row.allowed;
      const Real by = std::max(-row.impulse, -w);
      if (by == 0) return w * row.root < near;
      apply(line, row, by, changes_);
      row.impulse += by;
      worst = std::max(worst, row.root * std::abs(by));
      changed += by * by;
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
    if (all && worst <= done) break;  // others may close in that had no turn
    if (sweep + kPlainSweeps >= options.most_sweeps) continue;
    // What a sweep changes is the gradient of conjugate gradients (Silcowitz, Niebe, Erleben 2010): the last
    // direction is gone on with as far as Fletcher and Reeves say, or forgotten where that does not help.
    Real go_on = last > 0 ? changed / last : 0;
    last = changed;
    if (go_on > 1 || all) {  // where that does not help, and with other rows: anew
      std::fill(row_direction_.begin(), row_direction_.end(), Real(0));
      std::fill(direction_.begin(), direction_.end(), Vec8(Vec8::Zero()));
      go_on = 0;
    }
    for (const int r : waiting_) {
      Row& row = rows_[at(r)];
      Real& direction = row_direction_[at(r)];
      const Real step = row.impulse - row.before;
      row.impulse += go_on * direction;
      direction = go_on * direction + step;
    }
    for (std::size_t k = 0; k < changes_.size(); ++k) {
      const Vec8 step = changes_[k] - before_[k];
      changes_[k] += go_on * direction_[k];
      direction_[k] = go_on * direction_[k] + step;
    }
  }
  waiting_.clear();
  for (int body = 0; body < static_cast<int>(masses_.size()); ++body)
    if (masses_[at(body)].inverse > 0) work_out(body);
  return residual();
}

template <class Real>
void Rows<Real>::join_rows() {
  if (!start_of_.empty()) return;
  start_of_.assign(masses_.size() + 1, 0);
  for (const Row& row : rows_) {
    ++start_of_[at(row.a) + 1];
    ++start_of_[at(row.b) + 1];
  }
  for (std::size_t i = 1; i < start_of_.size(); ++i) start_of_[i] += start_of_[i - 1];
  row_of_.resize(at(start_of_.back()));
  next_.assign(start_of_.begin(), start_of_.end() - 1);
  for (int r = 0; r < rows(); ++r)
    for (const int body : {rows_[at(r)].a, rows_[at(r)].b}) row_of_[at(next_[at(body)]++)] = r;
}

template <class Real>
template <bool kVelocity>
void Rows<Real>::spread(const CrowdOptions& options, int& sweeps) {
  std::vector<Vec8>& y = kVelocity ? changes_ : displacements_;
  const auto enough = static_cast<Real>(options.enough);
  const auto farthest = static_cast<Real>(options.farthest * options.farthest);
  const auto is_far = [&](int body) {
    return y[at(body)].squaredNorm() * masses_[at(body)].reach > farthest;
  };
  unsaid_.assign(y.size(), 0);
  for (int pass = 0; pass < options.most_passes && !waiting_.empty(); ++pass) {
    ++sweeps;
    next_.clear();
    for (const int r : waiting_) is_waiting_[at(r)] = 0;
    for (const int r : waiting_) {
      Row& row = rows_[at(r)];
      const Line& line = lines_[at(r)];
      Real& impulse = kVelocity ? row.impulse : row.push;
      const Real w = along(line, row, y) + (kVelocity ? row.allowed : row.room);
      const Real by = std::max(-impulse, -w);
      if (by == 0) continue;
      // Where rows contradict each other, displacements would grow from pass to pass.
      if (!kVelocity && by > 0 && (is_far(row.a) || is_far(row.b))) continue;
      apply(line, row, by, y);
      impulse += by;
      for (const int body : {row.a, row.b}) {
        if (masses_[at(body)].inverse == 0) continue;
        touch(body);
        Real& unsaid = unsaid_[at(body)];  // what its other rows have not heard of yet
        unsaid += row.root * std::abs(by);
        if (unsaid <= enough) continue;
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

template <class Real>
void Rows<Real>::relax(std::span<const int> from, const CrowdOptions& options, int& sweeps) {
  join_rows();
  is_waiting_.assign(rows_.size(), 0);
  waiting_.assign(from.begin(), from.end());
  for (const int body : touched_)
    waiting_.insert(waiting_.end(), row_of_.begin() + start_of_[at(body)],
                    row_of_.begin() + start_of_[at(body) + 1]);
  spread<true>(options, sweeps);
  for (const int body : touched_) work_out(body);
}

template <class Real>
void Rows<Real>::displace(std::span<const double> slack, const CrowdOptions& options, int& sweeps) {
  join_rows();
  is_waiting_.assign(rows_.size(), 0);
  waiting_.clear();
  for (int r = 0; r < rows(); ++r) {
    Row& row = rows_[at(r)];
    row.room = static_cast<Real>(slack[at(r)]) / row.root - along(lines_[at(r)], row, displacements_);
    if (slack[at(r)] < 0) waiting_.push_back(r);
  }
  spread<false>(options, sweeps);
}

template <class Real>
typename Rows<Real>::Twist Rows<Real>::displacement(int body) const {
  const Eigen::Matrix<double, 8, 1> y = displacements_[at(body)].template cast<double>();
  const Mass& mass = masses_[at(body)];
  return {mass.root.cwiseProduct(y.template head<3>()), mass.turn_root * y.template segment<3>(3)};
}

template <class Real>
void Rows<Real>::forget_displacements() {
  std::fill(displacements_.begin(), displacements_.end(), Vec8(Vec8::Zero()));
  for (Row& row : rows_) row.push = 0;
}

template <class Real>
std::vector<int> Rows<Real>::take_touched() {
  for (const int body : touched_) is_touched_[at(body)] = 0;
  return std::exchange(touched_, {});
}

template class Rows<float>;
template class Rows<double>;

}  // namespace fc::resting

#include "common/motion_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fc {
namespace {

// Keys of all bodies together. A key is 32 bytes, so this makes a file of some 32 MB and a page of 43 MB,
// which browsers still play smoothly; beyond it only every 2nd, 4th, ... frame is kept.
constexpr std::size_t kMostKeys = 1'000'000;
// Viewers turn a body the shorter way round between two keys: they must be less than half a turn apart.
constexpr double kTurnBetweenKeys = 0.5 * std::numbers::pi;  // rad
// A body that turns by more than this many quarters between two frames is a blur anyway.
constexpr int kMostKeysBetween = 64;

Quat turned(const RigidBody& body, double time) {
  const double rate = body.spin.norm();
  if (rate == 0) return body.orientation;
  return Quat(Eigen::AngleAxisd(rate * time, body.spin / rate)) * body.orientation;
}

}  // namespace

MotionRecording::MotionRecording(std::string title, std::string chapter, double frame_dt)
    : title_(std::move(title)), chapter_(std::move(chapter)), frame_dt_(frame_dt) {}

void MotionRecording::add_shape(const Shape& shape) {
  shapes_.push_back(shape);
}

void MotionRecording::add_body(int shape, const RigidBody& body) {
  if (shape < 0 || shape >= static_cast<int>(shapes_.size()))
    throw std::invalid_argument(
        fmt::format("body of shape {}, but there are {} shapes", shape, shapes_.size()));
  const bool moves = !body.is_static() || !body.velocity.isZero(0) || !body.spin.isZero(0);
  bodies_.push_back({shape, moves, body, 0, {}});
}

void MotionRecording::add_hull(int shape, int level, const TriangleMesh& hull) {
  hulls_.push_back({shape, level, hull});
}

void MotionRecording::frame(double t, const std::vector<RigidBody>& bodies) {
  if (bodies.size() != bodies_.size())
    throw std::invalid_argument(
        fmt::format("a frame of {} bodies, but {} were added", bodies.size(), bodies_.size()));
  kept_ = frames_++ % stride_ == 0;
  if (!kept_) return;
  frame_times_.push_back(t);
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies_[i].moves) add_key(bodies_[i], t, bodies[i], true);
  while (keys_ > kMostKeys && frame_times_.size() > 2) thin_out();
}

void MotionRecording::key(int body, double t, const RigidBody& state) {
  if (bodies_.at(static_cast<std::size_t>(body)).moves) add_key(bodies_[body], t, state, false);
}

void MotionRecording::contact(double t, const Vec3& point, const Vec3& normal, double size, bool rests) {
  if (!std::isfinite(t) || !point.allFinite() || !normal.allFinite() || !std::isfinite(size))
    throw std::invalid_argument(fmt::format("a contact at {} s of {} N s that is not finite", t, size));
  contacts_.push_back({t, point, normal, size, rests});
}

void MotionRecording::value(const std::string& group, const std::string& name, const std::string& unit,
                            double value) {
  if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("{} is {} {}", name, value, unit));
  if (!kept_) return;
  const auto series =
      std::find_if(series_.begin(), series_.end(), [&](const Series& s) { return s.name == name; });
  if (series != series_.end())
    series->values.push_back(static_cast<float>(value));
  else
    series_.push_back({group, name, unit, {static_cast<float>(value)}});
}

void MotionRecording::add_key(Body& body, double t, const RigidBody& state, bool frame) {
  if (!std::isfinite(t) || !state.position.allFinite() || !state.orientation.coeffs().allFinite())
    throw std::invalid_argument(
        fmt::format("a pose at {} s that is not finite: x = {} m", t, state.position.x()));
  if (!body.keys.empty()) {
    const double gap = t - body.time;
    const double quarters =
        std::min(body.last.spin.norm() * gap / kTurnBetweenKeys, double{kMostKeysBetween});
    const int parts = 1 + static_cast<int>(quarters);
    for (int k = 1; k < parts; ++k) {
      const double share = static_cast<double>(k) / parts;
      push(body, body.time + share * gap, (1 - share) * body.last.position + share * state.position,
           turned(body.last, share * gap), false);
    }
  }
  push(body, t, state.position, state.orientation, frame);
  body.last = state;
  body.time = t;
}

void MotionRecording::push(Body& body, double t, const Vec3& position, const Quat& orientation, bool frame) {
  Quat q = orientation.normalized();
  if (!body.keys.empty()) {
    const Key& last = body.keys.back();
    if (!(static_cast<float>(t) > last.t)) return;  // no later, as a float: the pose is the same to the eye
    const double same =
        q.x() * last.pose[3] + q.y() * last.pose[4] + q.z() * last.pose[5] + q.w() * last.pose[6];
    if (same < 0) q.coeffs() = -q.coeffs();  // the same rotation; of q and -q, the one nearer to the last
  }
  Key key{static_cast<float>(t), {}, frame};
  for (int k = 0; k < 3; ++k) key.pose[k] = static_cast<float>(position[k]);
  for (int k = 0; k < 4; ++k) key.pose[3 + k] = static_cast<float>(q.coeffs()[k]);
  body.keys.push_back(key);
  ++keys_;
}

void MotionRecording::thin_out() {
  // Every second one of the remaining frames stays.
  std::vector<double> times;
  for (std::size_t k = 0; k < frame_times_.size(); k += 2) times.push_back(frame_times_[k]);
  frame_times_ = std::move(times);
  for (Series& series : series_) {
    for (std::size_t k = 0; 2 * k < series.values.size(); ++k) series.values[k] = series.values[2 * k];
    series.values.resize((series.values.size() + 1) / 2);
  }
  keys_ = 0;
  for (Body& body : bodies_) {
    std::vector<Key> keys;
    bool keep = false;
    for (const Key& key : body.keys) {
      if (key.frame) keep = !keep;
      if (!key.frame || keep) keys.push_back(key);
    }
    body.keys = std::move(keys);
    keys_ += body.keys.size();
  }
  stride_ *= 2;
  kept_ = (frames_ - 1) % stride_ == 0;
}

}  // namespace fc

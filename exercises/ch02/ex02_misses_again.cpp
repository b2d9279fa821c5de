#include "ex02_misses_again.hpp"

#include <algorithm>
#include <limits>

#include "ch02_hull_hierarchy/steps.hpp"
#include "common/todo.hpp"

namespace fc::exercises {
namespace {

// Conservative advancement with two hierarchies: short, plausible, often right. There are four mistakes in
// it. Three were shipped in real libraries; the fourth only costs time.
struct Traversal {
  const hulls::HullModel& a;
  const ca::Motion& motion_a;
  const hulls::HullModel& b;
  const ca::Motion& motion_b;
  double end, tolerance;
  double t = 0;
  double step = 0;     // s, the longest that is safe for all leaves so far
  double nearest = 0;  // m, of all leaves that were looked at
  ca::PairPose pose{motion_a, motion_b, 0};
  std::int64_t node_pairs = 0;

  struct Looked {
    int i, j;
    double step, lower, upper;
  };

  Looked look(int i, int j) {
    ++node_pairs;
    const hulls::HullNode &node_a = a.tree.nodes[i], &node_b = b.tree.nodes[j];
    const ca::Convex hull_a = a.convex(node_a), hull_b = b.convex(node_b);
    const ca::GjkResult g = ca::distance(hull_a, hull_b, pose, {tolerance / 8, 1e-6, 128});
    const double room = g.lower - tolerance / 2;  // what a step may use up
    const double safe = room > 0 ? hulls::ball_step(motion_a, hull_a, node_a.radius, motion_b, hull_b,
                                                    node_b.radius, pose, g.normal, t, end, room)
                                       .time
                                 : 0;
    return {i, j, safe, g.lower, g.upper};
  }

  void visit(const Looked& pair) {
    if (pair.step >= step) return;     // nothing below it makes the step shorter
    if (pair.lower > nearest) return;  // something else is nearer
    const hulls::HullNode &node_a = a.tree.nodes[pair.i], &node_b = b.tree.nodes[pair.j];
    if (node_a.leaf() && node_b.leaf()) {
      step = pair.step;
      nearest = std::min(nearest, pair.upper);
      return;
    }
    const bool open_a = !node_a.leaf() && (node_b.leaf() || node_a.radius < node_b.radius);
    Looked first = open_a ? look(node_a.left, pair.j) : look(pair.i, node_b.left);
    Looked second = open_a ? look(node_a.right, pair.j) : look(pair.i, node_b.right);
    if (second.lower < first.lower) std::swap(first, second);
    visit(first);
    visit(second);
  }

  void start_at(double time) {
    t = time;
    pose = {motion_a, motion_b, t};
    step = nearest = std::numeric_limits<double>::infinity();
    visit(look(0, 0));
  }
};

}  // namespace

FirstContact first_contact(const hulls::HullModel& a, const ca::Motion& motion_a, const hulls::HullModel& b,
                           const ca::Motion& motion_b, double interval, double tolerance, int most) {
  FC_TODO("2.2");  // delete this line, and begin

  FirstContact answer;
  Traversal traversal{a, motion_a, b, motion_b, interval, tolerance};
  for (int k = 0; k < most; ++k) {
    traversal.start_at(answer.toc);
    answer.visited.push_back(answer.toc);
    answer.node_pairs = traversal.node_pairs;
    constexpr double shortest = 1e-5;  // s
    if (traversal.step < shortest) {   // it has converged
      answer.status = ca::Status::contact;
      return answer;
    }
    answer.toc += traversal.step;
    if (answer.toc >= interval) {
      answer.status = ca::Status::separated;
      answer.toc = interval;
      return answer;
    }
  }
  answer.status = ca::Status::separated;
  answer.toc = interval;
  return answer;
}

}  // namespace fc::exercises

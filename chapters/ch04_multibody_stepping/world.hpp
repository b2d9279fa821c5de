// Many bodies in one world: the data that a step works on.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch04_multibody_stepping/clear/pieces.hpp"
#include "ch04_multibody_stepping/effects.hpp"
#include "ch04_multibody_stepping/paths.hpp"
#include "ch04_multibody_stepping/schedule.hpp"
#include "ch04_multibody_stepping/torque_free.hpp"
#include "common/pair_rules.hpp"
#include "common/scene.hpp"
#include "common/shape.hpp"

namespace fc::world {

// A motion that is not free flight, from the body's `time` on: the body moves straight and turns with constant spin,
// and its velocities meanwhile change evenly. The bodies of one plan are proved to keep apart from each other, and from
// all static and kinematic bodies, until they get another motion.
struct Plan {
  int number = -1;                                     // -1: the body flies
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  // m/s, rad/s, of the path
  Vec3 push = Vec3::Zero(), turn = Vec3::Zero();       // m/s^2, rad/s^2, of the velocities
};

// A body, and the time (s, within the frame) at which its state stands. Between its own events a body is not touched:
// its state at another time follows from its motion (constant spin, or torque-free rotation; constant velocity, or
// exact free fall; with or without drag).
struct Body {
  RigidBody state;
  double time = 0;
  int shape = 0;
  // Frozen until the frame's end, see step(): it keeps its velocities, but stays where it is; or, if it is one of a
  // group that touches nothing fixed, it moves with the group's centre of mass.
  bool frozen = false;
  int group = -1;  // the group's number, which is one of its bodies; -1: it stays where it is
  Vec3 group_velocity = Vec3::Zero();  // m/s, of the group's centre of mass, at `time`
  bool sensor = false;                 // reports contacts, resolves none
  bool asleep = false;                 // at rest until something hits it: see sleep.hpp
  bool was_frozen = false;             // until the end of the last frame
  bool lies = false;                   // frozen, and rests on nothing that moves
  Plan plan;                           // set by a Planner
  // For a kinematic body with a path: the path, and the time on it (s) at which the frame, or the part of it that is
  // being stepped, began. This is the world's time, less the time for which the body was frozen.
  std::shared_ptr<const Path> path;
  double clock = 0;
  double still = 0;  // s, for how long it has been frozen in place without a break
  // With the gyroscopic effect: its rotation since the last impact, and where on it the body is at `time`.
  std::shared_ptr<const ca::VaryingSpin> free;
  double free_start = 0, free_rate = 1;
};

// A sensor, and a body that has come to touch it.
struct Sighting {
  double time = 0;  // s in the frame
  int sensor = 0, body = 0;
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();  // m, world; unit, from the sensor to the body
  double gap = 0;                                    // m; negative if they overlap
  double speed = 0;                                  // m/s, n.(v_body - v_sensor) there
};

// A body's state with the velocities at which it moves: if it is frozen, its group's or none; if it is planned, its
// path's.
RigidBody as_it_moves(const Body& body, RigidBody state);

struct World {
  std::vector<Shape> shapes;
  std::vector<hulls::Model> models;         // one for each shape
  PairRules pair_rules;                     // what the scene says of two shapes
  std::vector<double> ball_radius;          // m, of each shape that is a ball; else 0
  std::vector<Vec3> half_extents;           // m, of each shape along its own axes, from its centre of mass
  std::vector<PrincipalInertia> principal;  // of each shape; empty without the gyroscopic effect
  std::vector<Body> bodies;
  mutable hulls::SearchMemory memory;        // of the search for a pair's next contact: a cache, not a state
  Schedule schedule;                         // of the frame that is being stepped
  Effects effects;                           // what the scene asks for, or implies
  std::vector<std::pair<int, int>> sighted;  // sensors and the bodies that touch them now, in order
  double tolerance = 1e-6;                   // m; the scene's, or the least that rounding allows
  std::int64_t max_pairs = 1'000'000;  // of nodes, for one search; the next one goes on from where it ended
  double part_start =
      0;  // s, in the frame: the start of the part being stepped, from which the bodies' times count
  double rest_gap = 0;             // m; a pair is stopped at half of it; 0: of the tolerance
  lcp::ImpactOptions impact = {};  // the solver of an instant's contacts
  clear::GapRuleFunction* gap_rule = clear::gap_rule;
  clear::EventLoopFunction* event_loop = clear::event_loop;
  SolverSpec solver;  // the scene's `solver`

  const hulls::Model& model_of(int body) const { return models[bodies[body].shape]; }
  double keep() const { return std::max(tolerance, rest_gap); }  // m: see find_next_contact()
  double restitution_of(int a, int b) const {
    return pair_rules.restitution(shapes, bodies[a].shape, bodies[b].shape);
  }
  // Begins a new motion of the body: something other than its own motion has set its state at `time` (s in the frame).
  void set_motion(int body, const RigidBody& state, double time);
  // Moves the body's state on to `time`, and relabels this instant `relabel`.
  void advance_to(int body, double time, double relabel);
  // The motion of a body from a time in the frame on; a stationary body has none.
  ca::Motion motion(int body, double time) const;
  // The body's state at a time in the frame.
  RigidBody state_at(int body, double time) const;
  // Whether it stays where it is until the frame's end, unless something hits it. (It may have a velocity that it does
  // not follow.)
  bool is_stationary(int body) const {
    const Body& b = bodies[body];
    if ((b.frozen && b.group < 0) || b.asleep) return true;
    const bool falls =
        !b.state.is_static() && effects.gravity && b.plan.number < 0 && !b.state.free_moves.isZero(0);
    const RigidBody moving = as_it_moves(b, b.state);
    return !falls && moving.velocity.isZero(0) && moving.spin.isZero(0);
  }
  // Whether two bodies are frozen as parts of one group: they do not move relative to each other.
  bool frozen_together(int a, int b) const {
    return bodies[a].group >= 0 && bodies[a].group == bodies[b].group;
  }
  // Whether a plan has proved already that two bodies keep apart.
  bool planned_apart(int a, int b) const {
    const int plan_a = bodies[a].plan.number, plan_b = bodies[b].plan.number;
    return (plan_a >= 0 && (plan_a == plan_b || !is_dynamic(b))) || (plan_b >= 0 && !is_dynamic(a));
  }
  // Whether an impulse at the body's surface can turn it, or its spin moves its surface along the normal.
  bool turns(int body) const { return effects.arms || ball_radius[bodies[body].shape] == 0; }
  // Whether two bodies are to be queried for contacts: one of them moves, and one can be moved or is a sensor.
  bool may_meet(int a, int b) const {
    if (bodies[a].sensor || bodies[b].sensor) return !(is_stationary(a) && is_stationary(b));
    return !(is_stationary(a) && is_stationary(b)) && (is_dynamic(a) || is_dynamic(b)) &&
           !planned_apart(a, b);
  }
  bool convex(int body) const { return shapes[bodies[body].shape].convex(); }
  // Whether it moves, and no impulse can change that.
  bool is_moving_kinematic(int body) const { return !is_dynamic(body) && !is_stationary(body); }
  // Whether an impulse can move the body.
  bool is_dynamic(int body) const { return !bodies[body].state.is_static(); }
  // The acceleration that gravity gives a body, in a scene with gravity: none along fixed directions.
  Vec3 gravity_on(const RigidBody& state) const { return effects.gravity->cwiseProduct(state.free_moves); }
  // Add to a motion, which begins at the time of the body's state, what the effects change: forces alone, or all of it.
  void add_forces(const Body& body, ca::Motion& motion) const;
  void add_effects(int body, ca::Motion& motion) const;
  // The centre's position and velocity at a time in the frame, and its acceleration: all that matters for a ball.
  ca::Motion centre_motion(int body, double time) const;
  // A box around everything that the body reaches between two times in the frame, enlarged by the tolerance.
  Bounds swept_bounds(int body, double from, double to) const;
};

// Throws InputError for bad shapes (see build_shapes), and for two bodies that overlap by more than the tolerance.
World build_world(const Scene& scene);
// A world as `from` is now, its bodies' poses and velocities digit by digit, but with the rules of another scene: effects,
// restitutions and frictions, tolerance, solver. The scene's first shapes and bodies are those of `from`, and keep their
// hierarchies; more may follow. Bodies that sleep wake up. Between two frames only. Throws as build_world().
World rebuild_world(const Scene& scene, const World& from);

// What one step did and measured.
struct StepReport {
  int contacts = 0;  // points given to the solver
  int impacts = 0;   // points with an impulse
  int lcp_rows = 0;
  int solves = 0;
  double lcp_residual = 0;  // the worst
  double min_gap = 0;       // m, the smallest certified gap of the pairs that were examined; infinite if none
  double max_penetration = 0;  // m
  double lost_time = 0;        // s, the longest that a body was frozen
  double momentum_error =
      0;  // the worst change at an impact, relative to sum |p| and to sum (|x||p| + |I w|)
  double energy_error =
      0;  // J, the worst difference between the change at an impact and what the law predicts
  double energy_gain =
      0;  // J, the largest gain of kinetic energy at an impact, less what kinematic bodies did
  double kinematic_work = 0;  // J, done by kinematic bodies
  double slept_energy = 0;    // J, that bodies gave up when they fell asleep
  int falls_asleep = 0, wakes = 0, sightings = 0;
  std::int64_t pairs = 0;     // of bodies whose swept boxes overlap
  std::int64_t advances = 0;  // proved steps, over all queries
  std::int64_t queries = 0, node_pairs = 0, ccd_ns = 0, lcp_ns = 0, step_ns = 0;
  std::int64_t broad_ns = 0;  // of ccd_ns: boxes, and the tree of them, at the frame's start
};

// What an impulse was for: bodies that met, or (from chapter 5 on) a contact that lasts.
enum class ContactKind { impact, rest };

// One contact with an impulse, for contacts.csv.
struct ImpactRecord {
  double time = 0;  // s in the frame
  lcp::Contact contact;
  lcp::Impulse impulse;
  ContactKind kind = ContactKind::impact;
  int patch =
      -1;  // contacts of its two bodies with the same number share what acts along the surfaces; -1: it has its own
  // Along the surfaces: zero unless a later chapter's law acts there.
  Vec3 tangential = Vec3::Zero();                              // N s, on B
  Vec3 slip_before = Vec3::Zero(), slip_after = Vec3::Zero();  // m/s, of B's point relative to A's
};
using OnImpact = std::function<void(const ImpactRecord&)>;
using OnSighting = std::function<void(const Sighting&)>;
// Called after each solved instant, with the time in the frame: for tests that look between frames.
using OnInstant = std::function<void(const World&, double time)>;

// Receives what happens in a step. Each may be empty.
struct Listeners {
  OnImpact impact = {};
  OnInstant instant = {};
  OnSighting sighting = {};
};

// What a later chapter puts in the place of an instant's impacts: plans for bodies in contact, which go on together.
// Times are in s, within the frame. Each function returns the bodies that got a new motion.
class Planner {
 public:
  virtual ~Planner() = default;
  // A frame of dt seconds begins. All bodies fly, and their boxes are in the schedule.
  virtual std::vector<int> begin(World& world, double dt, StepReport& report, const Listeners& listeners) = 0;
  // When the next plan ends; infinite if there is none.
  virtual double next_end() const = 0;
  // Ends the plans that end now.
  virtual std::vector<int> end_plans(World& world, double now, StepReport& report,
                                     const Listeners& listeners) = 0;
  // Two bodies meet now that fly, or belong to different plans.
  virtual std::vector<int> meet(World& world, int a, int b, double now, StepReport& report,
                                const Listeners& listeners) = 0;
};

// One frame of dt seconds (> 0): from contact to contact.
//
// Conservative advancement finds the earliest contact of all pairs. All touching points of the bodies connected to it
// are solved as one LCP. The pairs of the bodies whose motion changed are queried again; and so on until no contact is
// left in the frame. Guarantee: two bodies that start apart keep a positive gap at all times (those that start
// touching, or overlapping by rounding, come nearer by at most 64 rounding terms). Where impacts pile up so that a pair
// has less than a hundredth of the tolerance left to spend, its island is frozen until the frame's end, and keeps its
// velocities. It stays where it is; or, if it touches nothing fixed, it goes on with its centre of mass, without
// turning, so that only the motion relative to that is lost. The simulated time that it misses is reported as
// lost_time. Throws NumericalFailure if an LCP cannot be solved, or a search reaches its limit without progress;
// std::invalid_argument for a dt that is not finite and > 0, and then nothing has moved.
StepReport step(World& world, double dt, const Listeners& listeners = {});
// The same with a planner. It plans the bodies that do not fly and solves all contacts; nothing is frozen.
StepReport step_with(Planner& planner, World& world, double dt, const Listeners& listeners = {});

}  // namespace fc::world

// Chapter 5's step: contacts that last are solved at the frame's start, the way that follows is proved and
// put right by positions alone, and everything else happens as in chapter 4.
#pragma once

#include <array>
#include <functional>

#include "ch05_resting_contact/crowd.hpp"
#include "ch05_resting_contact/envelope.hpp"
#include "ch05_resting_contact/island_solver.hpp"
#include "ch05_resting_contact/islands.hpp"
#include "ch05_resting_contact/path.hpp"

namespace fc::resting {

// What a frame did beyond chapter 4's report.
struct RestReport {
  world::StepReport step;  // all of the frame, resting contacts included
  int shell_contacts = 0;
  int resting = 0;                      // contacts that last, and got an impulse
  std::int64_t searched = 0;            // pairs whose contacts were searched anew
  std::int64_t checked = 0;             // ways of pairs through the frame that were to be proved
  int crowded = 0;                      // bodies in crowds: see Resting
  int rounds = 0;                       // in which velocities or ways were mended
  int put_back = 0;                     // times that a body's way in a crowd was shortened
  int stopped = 0;                      // bodies of crowds whose way could not be mended
  int largest_island = 0;               // rows
  int sweeps = 0, steering_sweeps = 0;  // of Gauss-Seidel, all islands
  double smallest_gap = 0;              // m, in the shell, at the frame's start; infinite if it is empty
  double steered = 0;                   // m, the largest that a body's point was moved to put gaps right
  double steering_energy = 0;           // J, potential energy that this added
};

struct RestOptions {
  int crowd = 400;  // rows of bodies that are near each other, beyond which they are a crowd
  // How other islands are solved: with the rows that come in within a frame they may become larger.
  IslandOptions small = {.most_dense_rows = 1000, .accepted = 1e-3};
  CrowdOptions crowded = {};
};

// Keeps what lasts from frame to frame.
class Resting {
 public:
  // Sets the world's touch and reserve, and in each part of a frame its rest_speed. Throws as envelope_of().
  Resting(const Scene& scene, world::World& world, double dt, const RestOptions& options = {});

  // One frame of dt seconds. Guarantees of chapter 4's step hold: no gap ever becomes zero. A pair within the
  // envelope whose bodies close in slower than the envelope's width in a frame is no event: it gets an
  // impulse at the frame's start so that at its end, to first order in dt, its gap is at least half the
  // envelope, or what it was. In a crowd nothing is an event: there, what comes in from outside of the shell
  // gets an impulse at the frame's start, too, with which it arrives at the frame's end. Throws
  // NumericalFailure if an island cannot be solved.
  RestReport step(world::World& world, const world::Listeners& listeners = {});

  double envelope() const { return shell_.envelope(); }

 private:
  // A part of a frame: all of it, or where that could not be mended, halves, quarters, ...
  struct Part {
    double start, length;  // s
    int level;
  };
  static constexpr int kMostHalvings = 4;
  static constexpr double kMostSteered = 2;  // of the envelope: no body is displaced by more
  void advance(world::World& world, const Part& part, const world::Listeners& listeners, RestReport& report);
  void begin(world::World& world, const Part& part, RestReport& report);
  Joined joined_by_contacts(const world::World& world) const;
  void wake_touched(world::World& world, RestReport& report);
  void fall_asleep(world::World& world, RestReport& report);
  bool rests(const world::World& world, int body) const {
    return world.bodies[body].asleep || !world.yields(body);
  }
  void find_crowds(const world::World& world);
  bool is_crowded(const lcp::Contact& c) const { return crowded_[at(c.body_a)] || crowded_[at(c.body_b)]; }
  bool is_crowded_pair(const ShellPair& pair) const { return crowded_[at(pair.a)] || crowded_[at(pair.b)]; }
  void take(const world::World& world);
  void solve(world::World& world, const std::vector<int>& members, RestReport& report);
  bool stop_driven(world::World& world, Island& island, RestReport& report);
  void solve_crowd(world::World& world, RestReport& report);
  void add_row(int contact);
  double allowed(ShellContact& contact) const;
  void move_in_crowd(world::World& world, int body, bool stands);
  int pushed(const world::World& world, int body);
  void move_touched(world::World& world);
  double slack(double gap) const;
  void steer_crowd(world::World& world, RestReport& report);
  void take_course(world::World& world, int number, bool pushed, bool supported, RigidBody state);
  void follow(const world::World& world, int body);
  void steer(world::World& world, RestReport& report);
  void steer_island(world::World& world, const std::vector<int>& members, RestReport& report);
  bool concerns(const world::World& world, const ShellPair& pair) const;
  double need(const world::World& world, const ShellPair& pair) const;
  bool prove(world::World& world, RestReport& report);
  void check_changed(const world::World& world, RestReport& report);
  bool put_back(world::World& world, RestReport& report);
  bool give_up_put_back();
  void halve(world::World& world, const Part& part, const world::Listeners& listeners, RestReport& report);
  bool finish(world::World& world, const Part& part, const world::Listeners& listeners, RestReport& report);
  void settle(world::World& world, RestReport& report);
  bool mend(world::World& world, ShellPair& pair, double time);
  void stop_crowd(world::World& world, RestReport& report);
  void keep_for_halves();
  void tell(const world::World& world, const world::Listeners& listeners, RestReport& report);
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }

  Shell shell_;
  IslandSolver solver_;
  Crowd crowd_;
  RestOptions options_;
  double frame_, dt_;  // s, of a frame, and of the part of it at hand
  int halvings_ = 0;   // with which the next frame begins
  std::array<std::vector<world::Body>, kMostHalvings + 1> saved_;  // as they were when a part began
  std::array<double, kMostHalvings + 1> lost_ = {};                // s, in the frame until then

  // Of each body: whether it is put back far in this frame, and was in the last one; for how long (s) it has
  // been carried, and slow.
  std::vector<char> is_far_, was_far_;
  std::vector<double> still_;

  // Of the frame at hand, for each body: as it was given, and with the velocity that gravity will have made
  // of it by the frame's end; its way through the frame; whether it is in a crowd, in an island (2: and was
  // pushed there), and has got another way since its pairs were looked at.
  std::vector<RigidBody> given_, start_;
  std::vector<Track> tracks_;
  std::vector<Sweep> sweeps_;
  std::vector<char> crowded_, resting_, changed_;
  // Pairs whose way is not proved, and the time at which they come too near.
  std::vector<std::pair<std::size_t, double>> open_;
  // Of bodies that are put back: their whole way in this part of the frame, and the share that is left.
  struct FullWay {
    double share = 1;
    bool far = false;                                    // it is put back by more than all may be
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();  // m/s, rad/s
  };
  std::vector<FullWay> full_ways_;
  std::vector<std::function<void()>> told_;  // by chapter 4's step, as soon as it may be
  // For each contact of the shell: whether it is a row of this chapter, which one of the crowd (or -1); and
  // its gap at the frame's end.
  std::vector<char> taken_;
  std::vector<int> row_;
  std::vector<int> contact_of_;  // of each of the crowd's rows
  std::vector<double> end_gaps_;
  std::vector<double> slacks_, reaches_;
  // Room for an island.
  std::vector<int> place_;
  std::vector<double> allowed_, impulses_;
};

}  // namespace fc::resting

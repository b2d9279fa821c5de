// The tables of a simulation (contract 1.5): steps.csv, contacts.csv and, if asked for, poses.csv; and its
// motion.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"
#include "common/motion_recording.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::world {

// Energies in J, momenta in kg m/s and kg m^2/s about the world's origin, of all bodies that can move.
struct Totals {
  double kinetic = 0, potential = 0;
  Vec3 momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();
};
Totals totals_of(const World& world);

// Columns that a later chapter adds to steps.csv and contacts.csv, after chapter 4's.
struct MoreColumns {
  std::vector<Column> columns = {};
  std::function<std::vector<Cell>()> cells = {};  // of the last frame; of row 0 before the first frame
  std::vector<Column> contact_columns = {};
  std::function<std::vector<Cell>(const ImpactRecord&)> contact_cells = {};
};

class Recorder {
 public:
  // kinds: contacts.csv has the column `kind`.
  Recorder(const Scene& scene, const World& world, const RunContext& context, bool kinds = false,
           const MoreColumns& more = {});

  void start(const World& world);  // row 0
  // Called inside a step, with times within the frame: these only store what they are given.
  void impact(const ImpactRecord& record) { impacts_.push_back(record); }
  void sighting(const Sighting& sighting) { sightings_.push_back(sighting); }
  void instant(const World& world, double time);
  // After a step that ended at t (s).
  void frame(const World& world, int number, double t, const StepReport& report);
  // An account of one frame, for the recording.
  void algorithm(std::string account) { motion_.algorithm(std::move(account)); }
  // Closes the tables and writes the motion; returns a remark on the motion for the summary.
  std::string close();

  const std::vector<StepReport>& reports() const { return reports_; }
  std::optional<double> first_impact() const { return first_impact_; }  // s

 private:
  void write_impacts(double frame_start);
  void write_sightings(double frame_start);
  void steps_row(const World& world, int number, double t, const StepReport& report);
  void poses_rows(const World& world, double t);
  void motion_frame(const World& world, double t, double impulse, int contacts, int impacts);

  struct Kink {  // a body's state just after an impact
    int body;
    double time;  // s in the frame
    RigidBody state;
  };

  bool kinds_;
  MoreColumns more_;
  TableWriter steps_, contacts_;
  std::optional<TableWriter> poses_, sensors_;
  MotionRecording motion_;
  std::filesystem::path folder_;
  double dt_;
  std::vector<ImpactRecord> impacts_;  // of the frame that is being stepped
  std::vector<Sighting> sightings_;    // of the same
  std::size_t impacts_seen_ = 0;       // how many of them belong to instants already solved
  std::vector<Kink> kinks_;
  std::vector<StepReport> reports_;
  std::optional<double> first_impact_;
};

// Adds to the summary what the reports of all frames give together.
void summarize(const Scene& scene, const World& world, const std::vector<StepReport>& reports,
               Summary& summary);

}  // namespace fc::world

// The tables of a simulation (contract 1.5): steps.csv, contacts.csv and, if asked for, poses.csv.
#pragma once

#include <optional>
#include <vector>

#include "ch04_multibody_stepping/world.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::world {

// Energies in J, momenta in kg m/s and kg m^2/s about the world's origin, of all bodies that can move.
struct Totals {
  double kinetic = 0, potential = 0;
  Vec3 momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();
};
Totals totals_of(const World& world);

class Recorder {
 public:
  Recorder(const RunContext& context);

  void start(const World& world);  // row 0
  void frame(const World& world, int number, double t, const StepReport& report);
  void impact(double t, const ImpactRecord& record);
  void close();

  const std::vector<StepReport>& reports() const { return reports_; }
  std::optional<double> first_impact() const { return first_impact_; }  // s

 private:
  void steps_row(const World& world, int number, double t, const StepReport& report);
  void poses_rows(const World& world, double t);

  TableWriter steps_, contacts_;
  std::optional<TableWriter> poses_;
  std::vector<StepReport> reports_;
  std::optional<double> first_impact_;
};

// What the reports say together: for the summary.
void summarize(const Scene& scene, const World& world, const std::vector<StepReport>& reports,
               Summary& summary);

}  // namespace fc::world

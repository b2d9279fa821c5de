// The residual that sweeps leave, and that solving all contacts at once leaves, for towers of boxes.
#pragma once

#include <string>
#include <vector>

namespace fc::friction {

struct TowerRow {
  int boxes = 0;
  std::string method;      // sweeps, or together: all contacts at once
  int steps = 0;           // sweeps, or rounds after some sweeps
  double looks = 0;        // visits to each contact; a step of Newton's method counts as many
  double residual = 0;     // see ContactSweeps
  double force_error = 0;  // of the force under the lowest box, over the tower's weight
};

// A tower of boxes of 1 m and 1 kg, four corners each, µ = 0.5: the impulses of one frame of 1/60 s, without a guess.
std::vector<TowerRow> measure_tower(int boxes);

}  // namespace fc::friction

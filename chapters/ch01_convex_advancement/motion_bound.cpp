#include "ch01_convex_advancement/motion_bound.hpp"

#include <stdexcept>

namespace fc::ca {

MotionBound motion_bound_named(const std::string& name) {
  if (name == "directional") return MotionBound::directional;
  if (name == "naive") return MotionBound::naive;
  throw std::invalid_argument("the motion bound \"" + name + "\" is not known; known: directional, naive");
}

}  // namespace fc::ca

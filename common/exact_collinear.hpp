// Whether three points lie on one line, decided without rounding.
#pragma once

#include "common/types.hpp"

namespace fc {

// True if and only if a, b and c lie exactly on one line (two equal points do). The numbers are taken as they
// are: (0, 0, 0), (1, 3, 0) and (0.1, 0.3, 0) are not on one line, since 0.3 is not three times 0.1 in
// doubles. Exact as long as no product of two coordinates leaves the range in which doubles have all their
// digits (non-zero coordinates between 1e-130 and 1e150 in size).
bool exactly_collinear(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace fc

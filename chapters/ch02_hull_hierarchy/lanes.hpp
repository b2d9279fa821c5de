// Four floats side by side, and vectors of them: one instruction works on four boxes.
#pragma once

#include <cmath>
#include <limits>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace fc::hulls {

typedef float Lanes __attribute__((vector_size(16)));  // of GCC and Clang, on any processor
typedef int LaneMask __attribute__((vector_size(16)));

// The next float that is above x.
inline float float_above(double x) {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

inline Lanes all_lanes(float x) {
  return Lanes{x, x, x, x};
}
inline Lanes sqrt(Lanes x) {
#if defined(__SSE__)
  return _mm_sqrt_ps(x);
#else
  return Lanes{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}
inline Lanes max(Lanes x, Lanes y) {
  return x > y ? x : y;
}
inline Lanes min(Lanes x, Lanes y) {
  return x < y ? x : y;
}
inline Lanes abs(Lanes x) {
  return (Lanes)((LaneMask)x & 0x7fffffff);
}

// Four vectors. Plain sums of products, in this order: code that builds boxes with floats and code that reads
// them get the same values.
struct Lanes3 {
  Lanes x, y, z;
};
inline Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Lanes3 operator*(Lanes s, const Lanes3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline Lanes dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Lanes3 cross(const Lanes3& a, const Lanes3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes3 select(LaneMask m, const Lanes3& a, const Lanes3& b) {
  return {m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z};
}

}  // namespace fc::hulls

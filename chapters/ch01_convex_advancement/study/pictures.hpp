// The tables behind chapter 1's drawings: planes, simplices, looks and paths, computed by the chapter's own
// code.
#pragma once

#include <filesystem>

#include "common/scene.hpp"

namespace fc::ca {

// Two flat polygons: the support gap along a few normals, and along all of them (slab_*.csv).
void draw_slabs(const std::filesystem::path& out);

// GJK on two flat polygons, stopped after one iteration, after two, ...: its simplex, its bounds (gjk_*.csv).
void draw_gjk(const std::filesystem::path& out);

// A turning bar: how fast its corners move along a fixed normal, and what bounds them (corners_*.csv).
void draw_corners(const std::filesystem::path& out);

// The same bar: which corner is ahead after h seconds, by the turned normal (turned_*.csv).
void draw_turned(const std::filesystem::path& out);

// The scene's flight: the true distance over time, where the advancement looks, what each certificate row
// promises, and the true gap along its normal (flight_*.csv). The motion bound and the tolerance are the
// scene's.
void draw_flight(const Scene& scene, const std::filesystem::path& out);

}  // namespace fc::ca

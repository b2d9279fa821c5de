// A scene as the text that read_scene() reads back: the way from plain data to a file.
#pragma once

#include <string>

#include "common/scene.hpp"

namespace fc {

// YAML in which every number has the shortest digits that give the same double again. Files (meshes, motions, paths, matrices)
// are named by their absolute paths, every body of a grid stands for itself, and a key whose value is its default is left out.
// Read back, all fields are the same, except for the marks of lines, and for roundings of turns: see below.
std::string scene_text(const Scene& scene);

// Digits of a quaternion that read_scene() turns into this one, to the last bit. Reading divides by the length, which for a
// quaternion of doubles is seldom exactly 1: so the digits are those of a multiple of it by 1 and some roundings, if they have
// to be. One quaternion in 150 has no such digits (its length is off by more than division leaves): then its own, and the one
// that is read differs by a rounding.
Eigen::Vector4d quaternion_digits(const Quat& quaternion);  // w, x, y, z

}  // namespace fc

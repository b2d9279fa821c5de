// The scenes of the benchmark: boxes in a pit, a wall and a stack; meshes. And how deep boxes overlap, whoever moved them.
#pragma once

#include <filesystem>
#include <vector>

#include "common/rigid_body.hpp"
#include "common/scene.hpp"

namespace fc::bench {

// Boxes of half a metre and a kilogram, turned at random, that fall into a pit: nx by ny in a layer.
Scene heap(int nx, int ny, int layers);
// A wall of columns between side walls, and thin ones before and behind it.
Scene wall(int columns, int rows);
Scene stack(int boxes);

// Meshes. A chain of links, straight, a millimetre of slack in every joint, that falls and is held at both ends. `file`: where
// the link is written.
Scene chain(int links, const std::filesystem::path& file);
// Rings of a third of a metre that fall into a pit, four in a layer.
Scene rings(int count);
// The scene `bowl` of chapter 5: a bunny of 69,666 triangles.
Scene bunny_in_a_bowl();

// The deepest overlap of two boxes of the scene in these states, m; 0 if none overlap. By the fifteen axes of
// two boxes (Gottschalk, Lin, Manocha 1996): the smallest of the overlaps along them. Static boxes among
// themselves do not count.
double deepest_overlap(const Scene& scene, const std::vector<RigidBody>& states);

}  // namespace fc::bench

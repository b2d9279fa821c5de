// Boxes in a pit, a wall and a stack, and how deep boxes overlap, whoever moved them.
#pragma once

#include <vector>

#include "common/rigid_body.hpp"
#include "common/scene.hpp"

namespace fc::bench {

// Boxes of half a metre and a kilogram, turned at random, that fall into a pit: nx by ny in a layer.
Scene heap(int nx, int ny, int layers);
// A wall of columns between side walls, and thin ones before and behind it.
Scene wall(int columns, int rows);
Scene stack(int boxes);

// The deepest overlap of two boxes of the scene in these states, m; 0 if none overlap. By the fifteen axes of
// two boxes (Gottschalk, Lin, Manocha 1996): the smallest of the overlaps along them. Static boxes among
// themselves do not count.
double deepest_overlap(const Scene& scene, const std::vector<RigidBody>& states);

}  // namespace fc::bench

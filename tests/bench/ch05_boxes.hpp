// The scenes of chapters 5 and 6's benchmarks: boxes in a pit, walls, a stack, pyramids, an arch; meshes. And the depth
// by which bodies overlap, whichever engine moved them.
#pragma once

#include <filesystem>
#include <vector>

#include "common/rigid_body.hpp"
#include "common/scene.hpp"
#include "common/shape.hpp"

namespace fc::bench {

// Boxes of half a metre and a kilogram, turned at random, that fall into a pit: nx by ny in a layer.
Scene heap(int nx, int ny, int layers);
// A wall of columns between side walls, and thin ones before and behind it.
Scene wall(int columns, int rows);
Scene stack(int boxes);

// Without friction these fall. The same wall without walls around it.
Scene free_wall(int columns, int rows);
// In a plane, boxes of a metre, each across the gap between two below: `layers` at the bottom, one on top.
Scene pyramid(int layers);
// A semicircle of stones of a kilogram, hulls: 10 m to the middle of its thickness, which is 2 m. The joints are open by half of
// the envelope.
Scene arch(int stones);

// Meshes. A chain of links, straight, a millimetre of slack in every joint, that falls and is held at both ends. `file`: where
// the link is written.
Scene chain(int links, const std::filesystem::path& file);
// Rings of a third of a metre that fall into a pit, four in a layer.
Scene rings(int count);
// The scene `bowl` of chapter 5: a bunny of 69,666 triangles.
Scene bunny_in_a_bowl();

// How deep bodies overlap: boxes and hulls, by the axes of two convex polyhedra (Gottschalk, Lin, Manocha 1996, for boxes):
// across their faces, and across an edge of either.
class OverlapJudge {
 public:
  OverlapJudge(const Scene& scene, const std::vector<Shape>& shapes);
  // The deepest overlap of two bodies in these states, m: the smallest of the overlaps along the axes; 0 if no two overlap.
  // Static bodies among themselves do not count.
  double deepest(const std::vector<RigidBody>& states) const;

 private:
  struct Solid {
    std::vector<Vec3> corners, normals, edges;  // of parallel normals, and edges, only one
  };
  // A body in the world.
  struct Placed {
    Solid solid;
    Vec3 position;
  };
  static Solid solid_of(const Shape& shape);
  static double overlap(const Placed& a, const Placed& b);

  const Scene& scene_;
  std::vector<Solid> solids_;  // of the scene's shapes
};

}  // namespace fc::bench

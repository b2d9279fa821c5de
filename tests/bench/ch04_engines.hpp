// A scene in our engine, in Bullet and in ODE, behind one interface; other files do not include the peers' headers.
#pragma once

#include <memory>
#include <vector>

#include "common/rigid_body.hpp"
#include "common/scene.hpp"
#include "common/shape.hpp"

namespace fc::bench {

class Engine {
 public:
  virtual ~Engine() = default;
  virtual void step(double dt) = 0;
  // The state of a body: position (of the centre of mass), orientation, velocity, spin. The rest is not set.
  virtual RigidBody state(int body) const = 0;
  // Contact points that the last step handled.
  virtual int contacts() const = 0;
};

// Balls, blocks, hulls and meshes, without damping or sleep; each with its own defaults for the
// rest. `shapes` are those of the scene, built.
std::unique_ptr<Engine> make_ours(const Scene& scene);
// `iterations`: of the solver; those given are the engines' own defaults. `friction`: Coulomb's coefficient, of all pairs.
std::unique_ptr<Engine> make_bullet(const Scene& scene, const std::vector<Shape>& shapes, bool ccd,
                                    int iterations = 10, double friction = 0);
std::unique_ptr<Engine> make_ode(const Scene& scene, const std::vector<Shape>& shapes, int iterations = 20,
                                 double friction = 0);

}  // namespace fc::bench

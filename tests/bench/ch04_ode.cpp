// ODE, double precision: QuickStep with its 20 iterations, a hash space, up to eight contacts a pair. Hulls
// are given as ODE's convex geoms.
#include <ode/ode.h>

#include <map>

#include "common/convex_hull.hpp"
#include "tests/bench/ch04_engines.hpp"

namespace fc::bench {
namespace {

constexpr int kContacts = 8;

// ODE keeps pointers to a convex geom's planes, points and polygons.
struct HullData {
  std::vector<dReal> planes, points;
  std::vector<unsigned> polygons;
};

HullData hull_data(const TriangleMesh& core) {
  HullData data;
  for (const Vec3& v : core.vertices) data.points.insert(data.points.end(), {v.x(), v.y(), v.z()});
  for (const auto& t : core.triangles) {
    const Vec3 a = core.vertices[static_cast<std::size_t>(t[0])],
               b = core.vertices[static_cast<std::size_t>(t[1])],
               c = core.vertices[static_cast<std::size_t>(t[2])];
    const Vec3 n = (b - a).cross(c - a).normalized();
    data.planes.insert(data.planes.end(), {n.x(), n.y(), n.z(), n.dot(a)});
    data.polygons.insert(data.polygons.end(), {3U, static_cast<unsigned>(t[0]), static_cast<unsigned>(t[1]),
                                               static_cast<unsigned>(t[2])});
  }
  return data;
}

class OdeEngine : public Engine {
 public:
  OdeEngine(const Scene& scene, const std::vector<Shape>& shapes, int iterations, double friction)
      : shapes_(shapes), friction_(friction) {
    dInitODE2(0);
    dRandSetSeed(0);  // the seed of its row order: otherwise a row would depend on those that ran before it
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    joints_ = dJointGroupCreate(0);
    const Vec3 gravity = scene.gravity.value_or(Vec3(Vec3::Zero()));
    dWorldSetGravity(world_, gravity.x(), gravity.y(), gravity.z());
    dWorldSetDamping(world_, 0, 0);
    dWorldSetQuickStepNumIterations(world_, iterations);
    for (const BodySpec& spec : scene.bodies) {
      const Shape& shape = shapes[static_cast<std::size_t>(spec.shape)];
      const RigidBody start = make_body(shape, spec);
      restitution_.push_back(shape.restitution);
      geoms_.push_back(geom_of(spec.shape));
      const dGeomID geom = geoms_.back();
      const Quat& o = start.orientation;
      const dQuaternion q = {o.w(), o.x(), o.y(), o.z()};
      dBodyID body = nullptr;
      if (!start.is_static()) {
        body = dBodyCreate(world_);
        dMass mass;
        const Mat3& i = start.inertia_body;
        dMassSetParameters(&mass, start.mass, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
        dBodySetMass(body, &mass);
        dBodySetPosition(body, start.position.x(), start.position.y(), start.position.z());
        dBodySetQuaternion(body, q);
        dBodySetLinearVel(body, start.velocity.x(), start.velocity.y(), start.velocity.z());
        dBodySetAngularVel(body, start.spin.x(), start.spin.y(), start.spin.z());
        dBodySetAutoDisableFlag(body, 0);
        dBodySetGyroscopicMode(body, scene.gyroscopic ? 1 : 0);
        dGeomSetBody(geom, body);
      } else {
        dGeomSetPosition(geom, start.position.x(), start.position.y(), start.position.z());
        dGeomSetQuaternion(geom, q);
      }
      bodies_.push_back(body);
      starts_.push_back(start);
    }
    // Only now, when the vector's elements no longer move.
    for (std::size_t i = 0; i < geoms_.size(); ++i) dGeomSetData(geoms_[i], &restitution_[i]);
  }
  ~OdeEngine() override {
    dJointGroupDestroy(joints_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  void step(double dt) override {
    contacts_ = 0;
    dSpaceCollide(space_, this,
                  [](void* self, dGeomID a, dGeomID b) { static_cast<OdeEngine*>(self)->meet(a, b); });
    dWorldQuickStep(world_, dt);
    dJointGroupEmpty(joints_);
  }
  RigidBody state(int index) const override {
    const dBodyID body = bodies_[static_cast<std::size_t>(index)];
    if (body == nullptr) return starts_[static_cast<std::size_t>(index)];
    RigidBody state;
    const dReal *x = dBodyGetPosition(body), *q = dBodyGetQuaternion(body), *v = dBodyGetLinearVel(body),
                *w = dBodyGetAngularVel(body);
    state.position = {x[0], x[1], x[2]};
    state.orientation = Quat(q[0], q[1], q[2], q[3]);
    state.velocity = {v[0], v[1], v[2]};
    state.spin = {w[0], w[1], w[2]};
    return state;
  }
  int contacts() const override { return contacts_; }

 private:
  dGeomID geom_of(int index) {
    const Shape& shape = shapes_[static_cast<std::size_t>(index)];
    if (shape.kind == Shape::Kind::sphere) return dCreateSphere(space_, shape.radius);
    if (shape.kind == Shape::Kind::box) {
      Vec3 half = Vec3::Zero();
      for (const Vec3& v : shape.core.vertices) half = half.cwiseMax(v.cwiseAbs());
      return dCreateBox(space_, 2 * half.x(), 2 * half.y(), 2 * half.z());
    }
    const HullData& hull = hulls_.try_emplace(index, hull_data(shape.core)).first->second;
    return dCreateConvex(
        space_, const_cast<dReal*>(hull.planes.data()), static_cast<unsigned>(hull.planes.size() / 4),
        const_cast<dReal*>(hull.points.data()), static_cast<unsigned>(hull.points.size() / 3),
        const_cast<unsigned*>(hull.polygons.data()));
  }
  void meet(dGeomID a, dGeomID b) {
    if (dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) return;
    dContact contacts[kContacts];
    const int count = dCollide(a, b, kContacts, &contacts[0].geom, sizeof(dContact));
    const double restitution =
        std::max(*static_cast<double*>(dGeomGetData(a)), *static_cast<double*>(dGeomGetData(b)));
    for (int i = 0; i < count; ++i) {
      contacts[i].surface = {};
      contacts[i].surface.mode = dContactBounce;
      if (friction_ > 0) contacts[i].surface.mode |= dContactApprox1;  // µ times the normal impulse
      contacts[i].surface.mu = friction_;
      contacts[i].surface.bounce = restitution;
      contacts[i].surface.bounce_vel = 0;
      dJointAttach(dJointCreateContact(world_, joints_, &contacts[i]), dGeomGetBody(a), dGeomGetBody(b));
    }
    contacts_ += count;
  }

  const std::vector<Shape>& shapes_;
  double friction_;
  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
  std::map<int, HullData> hulls_;
  std::vector<dGeomID> geoms_;
  std::vector<dBodyID> bodies_;
  std::vector<RigidBody> starts_;
  std::vector<double> restitution_;
  int contacts_ = 0;
};

}  // namespace

std::unique_ptr<Engine> make_ode(const Scene& scene, const std::vector<Shape>& shapes, int iterations,
                                 double friction) {
  return std::make_unique<OdeEngine>(scene, shapes, iterations, friction);
}

}  // namespace fc::bench

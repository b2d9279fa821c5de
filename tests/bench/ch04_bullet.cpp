// Bullet 3, double precision: sequential impulses, ten iterations, its default. Restitution needs the
// threshold of speed at zero, or slow impacts would be inelastic. Convex shapes carry a margin of 4 cm around
// them by default; it is set to 1 mm, or its blocks would be larger than ours.
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>

#include "tests/bench/ch04_engines.hpp"

namespace fc::bench {
namespace {

constexpr double kMargin = 1e-3;  // m

btVector3 vector(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
Vec3 vec(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

struct Collider {
  std::unique_ptr<btTriangleIndexVertexArray> triangles;
  std::unique_ptr<btCollisionShape> shape;
};

Collider collider_of(const Shape& shape) {
  Collider collider;
  if (shape.kind == Shape::Kind::sphere) {
    collider.shape = std::make_unique<btSphereShape>(shape.radius);
    return collider;
  }
  if (shape.kind == Shape::Kind::mesh) {
    const auto& mesh = shape.core;
    collider.triangles = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangles.size()), const_cast<int*>(mesh.triangles.data()->data()),
        3 * static_cast<int>(sizeof(int)), static_cast<int>(mesh.vertices.size()),
        const_cast<double*>(mesh.vertices.data()->data()), static_cast<int>(sizeof(Vec3)));
    auto gimpact = std::make_unique<btGImpactMeshShape>(collider.triangles.get());
    gimpact->setMargin(kMargin);
    gimpact->updateBound();
    collider.shape = std::move(gimpact);
    return collider;
  }
  if (shape.kind == Shape::Kind::box) {
    Vec3 half = Vec3::Zero();
    for (const Vec3& v : shape.core.vertices) half = half.cwiseMax(v.cwiseAbs());
    collider.shape = std::make_unique<btBoxShape>(vector(half));
  } else {
    auto hull = std::make_unique<btConvexHullShape>();
    for (const Vec3& v : shape.core.vertices) hull->addPoint(vector(v));
    collider.shape = std::move(hull);
  }
  collider.shape->setMargin(kMargin);
  return collider;
}

class BulletEngine : public Engine {
 public:
  BulletEngine(const Scene& scene, const std::vector<Shape>& shapes, bool ccd, int iterations,
               double friction)
      : dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher_);
    const Vec3 gravity = scene.gravity.value_or(Vec3(Vec3::Zero()));
    world_.setGravity(vector(gravity));
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0;
    world_.getSolverInfo().m_numIterations = iterations;
    for (const Shape& shape : shapes) colliders_.push_back(collider_of(shape));
    for (const BodySpec& spec : scene.bodies) {
      const Shape& shape = shapes[static_cast<std::size_t>(spec.shape)];
      const RigidBody start = make_body(shape, spec);
      // Principal axes: ours are the shape's own axes for all but the bunny, whose products of inertia are
      // left out, as most users of Bullet do.
      const Vec3 inertia = start.inertia_body.diagonal();
      btRigidBody::btRigidBodyConstructionInfo info(
          start.mass, nullptr, colliders_[static_cast<std::size_t>(spec.shape)].shape.get(), vector(inertia));
      info.m_friction = std::sqrt(friction);  // a pair takes the product
      info.m_rollingFriction = 0;
      info.m_restitution = shape.restitution;
      info.m_linearDamping = info.m_angularDamping = 0;
      bodies_.push_back(std::make_unique<btRigidBody>(info));
      btRigidBody& body = *bodies_.back();
      const Quat& q = start.orientation;
      body.setWorldTransform(btTransform(btQuaternion(q.x(), q.y(), q.z(), q.w()), vector(start.position)));
      body.setInterpolationWorldTransform(body.getWorldTransform());
      body.setLinearVelocity(vector(start.velocity));
      body.setAngularVelocity(vector(start.spin));
      body.setActivationState(DISABLE_DEACTIVATION);
      if (!scene.gyroscopic) body.setFlags(0);
      if (ccd && start.mass > 0) {
        body.setCcdMotionThreshold(0.25 * shape.reach);
        body.setCcdSweptSphereRadius(0.4 * shape.reach);
      }
      world_.addRigidBody(&body);
    }
  }
  ~BulletEngine() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  void step(double dt) override { world_.stepSimulation(dt, 0); }  // one step of dt
  RigidBody state(int index) const override {
    const btRigidBody& body = *bodies_[static_cast<std::size_t>(index)];
    RigidBody state;
    state.position = vec(body.getWorldTransform().getOrigin());
    const btQuaternion q = body.getWorldTransform().getRotation();
    state.orientation = Quat(q.w(), q.x(), q.y(), q.z());
    state.velocity = vec(body.getLinearVelocity());
    state.spin = vec(body.getAngularVelocity());
    return state;
  }
  int contacts() const override {
    int count = 0;
    auto& dispatcher = const_cast<btCollisionDispatcher&>(dispatcher_);
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
      for (int k = 0; k < dispatcher.getManifoldByIndexInternal(i)->getNumContacts(); ++k)
        count += dispatcher.getManifoldByIndexInternal(i)->getContactPoint(k).getDistance() <= 0;
    return count;
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<Collider> colliders_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

std::unique_ptr<Engine> make_bullet(const Scene& scene, const std::vector<Shape>& shapes, bool ccd,
                                    int iterations, double friction) {
  return std::make_unique<BulletEngine>(scene, shapes, ccd, iterations, friction);
}

}  // namespace fc::bench

#include "common/shape.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/convex_hull.hpp"

namespace fc {
namespace {

// How far an explicit inertia may deviate from symmetry, relative to its largest entry: a rotation of a
// diagonal matrix in doubles stays well below it. Beyond it, the numbers are a mistake.
constexpr double kSymmetryTolerance = 1e-9;
// How far the largest principal moment may exceed the sum of the others, relative to it. A flat plate has
// equality, and people write such numbers with three digits.
constexpr double kTriangleTolerance = 1e-3;

std::string called(const ShapeSpec& spec) {
  return "shape '" + spec.name + "'";
}

void require(bool condition, const SourceMark& where, const std::string& message) {
  if (!condition) throw InputError(where, message);
}

// What follows from the geometry alone: the core in the shape's own frame, and its mass properties at 1
// kg/m^3.
struct Geometry {
  Shape::Kind kind = Shape::Kind::sphere;
  TriangleMesh core;
  double radius = 0;
  bool solid = true;
  MeshReport report;
  std::optional<MassProperties> unit;  // nothing: no volume that matter could fill
  bool unit_of_hull = false;           // `unit` is that of the convex hull, filled
  std::vector<double> disks = {};
  std::vector<Shape> parts = {};  // of a compound, in the shape's own frame
};

TriangleMesh box_core(const Vec3& size) {
  TriangleMesh core;
  for (int i = 0; i < 8; ++i) {
    const Vec3 sign((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
    core.vertices.push_back(sign.cwiseProduct(size) / 2);
  }
  core.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},   // -x, +x
                    {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},   // -y, +y
                    {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};  // -z, +z
  return core;
}

Geometry geometry_of(const SphereSpec& sphere, const ShapeSpec& spec) {
  require(sphere.radius > 0, spec.geometry_where, called(spec) + ": the radius must be > 0");
  return {Shape::Kind::sphere,
          {{Vec3::Zero()}, {}},
          sphere.radius,
          true,
          {},
          sphere_mass(sphere.radius, 1),
          false};
}

Geometry geometry_of(const BoxSpec& box, const ShapeSpec& spec) {
  require((box.size.array() > 0).all(), spec.geometry_where,
          called(spec) + ": each edge of the box must be > 0");
  return {Shape::Kind::box, box_core(box.size), 0, true, {}, box_mass(box.size, 1), false};
}

Geometry geometry_of(const CapsuleSpec& capsule, const ShapeSpec& spec) {
  require(capsule.radius > 0 && capsule.length > 0, spec.geometry_where,
          called(spec) + ": radius and length of the capsule must be > 0; without a length it is a sphere");
  const Vec3 end(0, 0, capsule.length / 2);
  return {Shape::Kind::capsule,
          {{-end, end}, {}},
          capsule.radius,
          true,
          {},
          capsule_mass(capsule.radius, capsule.length, 1),
          false};
}

// A cylinder, or a cone if the upper disk is a point.
Geometry turned_solid(Shape::Kind kind, double radius, double upper, double length,
                      const MassProperties& unit, const ShapeSpec& spec) {
  require(radius > 0 && length > 0, spec.geometry_where, called(spec) + ": radius and length must be > 0");
  const Vec3 end(0, 0, length / 2);
  return {kind, {{-end, end}, {}}, 0, true, {}, unit, false, {radius, upper}};
}

Geometry geometry_of(const CylinderSpec& c, const ShapeSpec& spec) {
  return turned_solid(Shape::Kind::cylinder, c.radius, c.radius, c.length,
                      cylinder_mass(c.radius, c.length, 1), spec);
}

Geometry geometry_of(const ConeSpec& c, const ShapeSpec& spec) {
  return turned_solid(Shape::Kind::cone, c.radius, 0, c.length, cone_mass(c.radius, c.length, 1), spec);
}

Geometry geometry_of(const HullSpec& hull, const ShapeSpec& spec) {
  const auto core = hull_mesh(hull.points);
  require(core.has_value(), spec.geometry_where,
          called(spec) + ": the hull spans no volume; give at least four points that are not in one plane");
  return {Shape::Kind::hull, *core, 0, true, {}, solid_mass(*core, 1), false};
}

Geometry geometry_of(const MeshSpec& mesh, const ShapeSpec& spec) {
  require(mesh.scale > 0, spec.geometry_where, called(spec) + ": the scale must be > 0");
  std::string left_out;
  TriangleMesh loaded = load_mesh(mesh.file, &left_out);
  for (Vec3& v : loaded.vertices) v *= mesh.scale;
  PreparedMesh prepared = prepare_mesh(loaded);
  prepared.report.left_out = left_out;
  require(!prepared.mesh.triangles.empty(), spec.geometry_where,
          called(spec) + ": every triangle of " + mesh.file.string() +
              " is degenerate; check the file's units and the scale");
  Geometry geometry{
      Shape::Kind::mesh, std::move(prepared.mesh), 0, prepared.report.solid, prepared.report, {}, false};
  if (geometry.solid) {
    geometry.unit = solid_mass(geometry.core, 1);
  } else if (const auto hull = hull_mesh(geometry.core.vertices)) {
    geometry.unit = solid_mass(*hull, 1);
    geometry.unit_of_hull = true;
  }
  return geometry;
}

// Adds a part's mass properties, rotated and moved into the whole's frame.
void add_mass(MassProperties& whole, const MassProperties& part, const Mat3& rotation, const Vec3& position) {
  const Vec3 center = rotation * part.center_of_mass + position;
  const auto about = [](const Vec3& d) { return d.squaredNorm() * Mat3::Identity() - d * d.transpose(); };
  const double mass = whole.mass + part.mass;
  const Vec3 middle = whole.center_of_mass + part.mass / mass * (center - whole.center_of_mass);
  whole.inertia += rotation * part.inertia * rotation.transpose() + part.mass * about(center - middle) +
                   whole.mass * about(whole.center_of_mass - middle);
  whole.mass = mass;
  whole.center_of_mass = middle;
}

Geometry geometry_of(const CompoundSpec& compound, const ShapeSpec& spec) {
  Geometry whole;
  whole.kind = Shape::Kind::compound;
  MassProperties unit{0, Vec3::Zero(), Mat3::Zero()};
  for (const PartSpec& part : compound.parts) {
    ShapeSpec alone = spec;
    alone.geometry_where = part.where;
    Geometry geometry = std::visit([&](const auto& g) { return geometry_of(g, alone); }, part.geometry);
    const Mat3 rotation = part.orientation.toRotationMatrix();
    add_mass(unit, *geometry.unit, rotation, part.position);
    Shape shape;
    shape.kind = geometry.kind;
    shape.radius = geometry.radius;
    shape.disks = std::move(geometry.disks);
    shape.axis = rotation.col(2);
    shape.core = std::move(geometry.core);
    const int first = static_cast<int>(whole.core.vertices.size());
    for (Vec3& v : shape.core.vertices) {
      v = rotation * v + part.position;
      whole.core.vertices.push_back(v);
    }
    for (const auto& [i, j, k] : shape.core.triangles)
      whole.core.triangles.push_back({first + i, first + j, first + k});
    whole.parts.push_back(std::move(shape));
  }
  whole.unit = unit;
  return whole;
}

// The centre of a surface that encloses no volume, nor does its hull: the mean over its area.
Vec3 area_centroid(const TriangleMesh& mesh) {
  double area = 0;
  Vec3 sum = Vec3::Zero();
  const Vec3 origin = mesh.vertices.front();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.vertices[i] - origin, b = mesh.vertices[j] - origin, c = mesh.vertices[k] - origin;
    const double twice = (b - a).cross(c - a).norm();
    area += twice;
    sum += twice / 3 * (a + b + c);
  }
  return origin + sum / area;
}

Mat3 checked_inertia(const ShapeSpec& spec) {
  const Mat3& given = *spec.inertia;
  const std::string who = called(spec) + ": the inertia ";
  const double largest = given.cwiseAbs().maxCoeff();
  require(
      given.allFinite() && (given - given.transpose()).cwiseAbs().maxCoeff() <= kSymmetryTolerance * largest,
      spec.where, who + "is not symmetric; write [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]");
  const Mat3 inertia = (given + given.transpose()) / 2;
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  require(moments[0] > 1e-15 * largest, spec.where,
          who + "is not positive definite; all three principal moments must be > 0");
  require(moments[2] <= (moments[0] + moments[1]) * (1 + kTriangleTolerance), spec.where,
          who +
              "belongs to no body: its largest principal moment exceeds the sum of the other two; check the "
              "numbers");
  return inertia;
}

void set_mass(Shape& shape, const Geometry& geometry, const ShapeSpec& spec) {
  const std::string of_hull = geometry.unit_of_hull ? ", of the convex hull" : "";
  const Vec3 centroid = geometry.unit ? geometry.unit->center_of_mass : area_centroid(geometry.core);
  if (spec.mass) require(*spec.mass > 0, spec.where, called(spec) + ": the mass must be > 0");
  if (spec.density) require(*spec.density > 0, spec.where, called(spec) + ": the density must be > 0");
  if (spec.inertia) {
    require(spec.mass.has_value(), spec.where, called(spec) + ": inertia without mass; add the mass");
    shape.mass = {*spec.mass, spec.center_of_mass.value_or(centroid), checked_inertia(spec)};
    shape.mass_source = "mass and inertia";
    return;
  }
  if (!spec.mass && !spec.density) {
    shape.mass.center_of_mass = centroid;  // so that a query's body turns about its true centre
    shape.mass_source = "none";
    return;
  }
  require(geometry.unit.has_value(), spec.where,
          called(spec) +
              ": the mesh is an open, flat surface, and no mass follows from it; give mass and inertia");
  shape.mass = scaled(*geometry.unit, spec.mass ? *spec.mass / geometry.unit->mass : *spec.density);
  shape.mass_source = (spec.mass ? "mass" : "density") + of_hull;
  if (geometry.kind == Shape::Kind::compound) shape.mass_source += ", each part counted in full";
}

// The largest distance of the shape from its centre of mass.
double reach_of(const Shape& shape) {
  double reach = 0;
  for (const Shape& part : shape.parts) reach = std::max(reach, reach_of(part));
  if (!shape.parts.empty()) return reach;
  for (std::size_t i = 0; i < shape.core.vertices.size(); ++i) {
    const Vec3& v = shape.core.vertices[i];
    const double disk = shape.disks.empty() ? 0 : shape.disks[i], along = shape.axis.dot(v);
    const double rim = disk > 0 ? std::hypot((v - along * shape.axis).norm() + disk, along) : v.norm();
    reach = std::max(reach, rim + shape.radius);
  }
  return reach;
}

}  // namespace

Eigen::AlignedBox3d bounds_of(const Shape& shape) {
  Eigen::AlignedBox3d box;
  for (const Shape& part : shape.parts) box.extend(bounds_of(part));
  if (!shape.parts.empty()) return box;
  // A disk reaches along x as far as the part of x that lies in its plane.
  const Vec3 flat = (Vec3::Ones() - shape.axis.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  for (std::size_t i = 0; i < shape.core.vertices.size(); ++i) {
    const Vec3 half = Vec3::Constant(shape.radius) +
                      (shape.disks.empty() ? Vec3(Vec3::Zero()) : Vec3(shape.disks[i] * flat));
    box.extend(shape.core.vertices[i] - half);
    box.extend(shape.core.vertices[i] + half);
  }
  return box;
}

Shape build_shape(const ShapeSpec& spec, double scene_restitution) {
  Geometry geometry = std::visit([&](const auto& g) { return geometry_of(g, spec); }, spec.geometry);
  Shape shape;
  shape.name = spec.name;
  shape.kind = geometry.kind;
  shape.radius = geometry.radius;
  shape.solid = geometry.solid;
  shape.restitution = spec.restitution.value_or(scene_restitution);
  shape.report = geometry.report;
  set_mass(shape, geometry, spec);
  require(shape.mass_source == "none" || (std::isnormal(shape.mass.mass) && shape.mass.inertia.allFinite() &&
                                          shape.mass.inertia.diagonal().minCoeff() > 0),
          spec.where,
          called(spec) + ": its mass or inertia is too small or too large for a double; check the units");

  shape.core = std::move(geometry.core);
  shape.disks = std::move(geometry.disks);
  shape.parts = std::move(geometry.parts);
  for (Vec3& v : shape.core.vertices) v -= shape.mass.center_of_mass;
  for (Shape& part : shape.parts)
    for (Vec3& v : part.core.vertices) v -= shape.mass.center_of_mass;
  shape.reach = reach_of(shape);
  constexpr double smallest = 1e-12, largest = 1e15;  // m: beyond, single precision cannot hold its boxes
  require(
      shape.reach >= smallest && shape.reach <= largest, spec.geometry_where,
      fmt::format(
          "{} reaches {:.3g} m from its centre of mass; {:g} m to {:g} m can be computed; change its size",
          called(spec), shape.reach, smallest, largest));
  return shape;
}

std::vector<Shape> build_shapes(const Scene& scene, bool masses_needed) {
  std::vector<Shape> shapes;
  shapes.reserve(scene.shapes.size());
  for (const ShapeSpec& spec : scene.shapes) {
    shapes.push_back(build_shape(spec, scene.restitution.value_or(0)));
    shapes.back().friction = spec.friction.value_or(scene.friction.value_or(0));
  }
  if (!masses_needed) return shapes;
  for (const BodySpec& body : scene.bodies) {
    const ShapeSpec& spec = scene.shapes.at(body.shape);
    require(body.is_static || body.is_kinematic || shapes[body.shape].mass.mass > 0, spec.where,
            called(spec) +
                " belongs to a body that moves, but has no mass; add 'density' or 'mass', or make the body "
                "'static: true'");
  }
  return shapes;
}

RigidBody make_body(const Shape& shape, const BodySpec& spec) {
  RigidBody body;
  body.orientation = spec.orientation.normalized();
  body.position = spec.position + body.orientation * shape.mass.center_of_mass;
  if (spec.is_static) return body;
  body.velocity = spec.velocity;
  body.spin = spec.spin;
  const bool stays = spec.free_moves.isZero(0) && spec.free_turns.isZero(0);
  if (!(shape.mass.mass > 0) || spec.is_kinematic || stays) return body;
  body.set_mass(shape.mass);
  body.guide(spec.free_moves, spec.free_turns);
  return body;
}

Vec3 frame_position(const Shape& shape, const RigidBody& body) {
  return body.position - body.orientation * shape.mass.center_of_mass;
}

}  // namespace fc

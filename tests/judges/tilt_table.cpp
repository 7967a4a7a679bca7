// A tilt table: Bullet's rigid-body dynamics say whether a body stands at a tilt. Knows nothing of Aplomb.
//
// Standard input, numbers apart by blanks; lengths in mm, the body at density 1:
//     volume   centroid x y z   inertia xx xy xz yy yz zz (about the centroid)
//     plate height z   n   x1 y1 ... xn yn (the support polygon, counter-clockwise)
//     then any number of:   direction_rad tilt_rad   (the way downhill, seen from above, and how steep)
// Standard output: for each of these a line, "stands" or "falls".

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

namespace {

constexpr double cm_per_mm = 0.1;  // bodies of about 10 units, where Bullet is at its best
constexpr btScalar gravity = 981;  // cm/s2
constexpr btScalar step_s = btScalar(1) / 1000;
constexpr double ramp_rad_per_s = 0.35;
constexpr double hold_s = 3;
constexpr btScalar fallen_rad = btScalar(0.05);

struct Body {
  btVector3 centroid;              // cm
  btMatrix3x3 inertia;             // of the body at mass 1, cm2
  btScalar plate = 0;              // cm
  std::vector<btVector3> polygon;  // cm, on the plate
};

btVector3 read_vector(std::istream& in) {
  double x = 0, y = 0, z = 0;
  in >> x >> y >> z;
  return {btScalar(x * cm_per_mm), btScalar(y * cm_per_mm), btScalar(z * cm_per_mm)};
}

Body read_body(std::istream& in) {
  double volume = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, plate = 0;
  std::size_t corners = 0;
  Body body;
  in >> volume;
  body.centroid = read_vector(in);
  in >> xx >> xy >> xz >> yy >> yz >> zz >> plate >> corners;
  const double scale = cm_per_mm * cm_per_mm / volume;  // how a body moves does not depend on its mass
  body.inertia = {btScalar(xx * scale), btScalar(xy * scale), btScalar(xz * scale),
                  btScalar(xy * scale), btScalar(yy * scale), btScalar(yz * scale),
                  btScalar(xz * scale), btScalar(yz * scale), btScalar(zz * scale)};
  body.plate = btScalar(plate * cm_per_mm);
  for (std::size_t i = 0; i < corners; ++i) {
    double x = 0, y = 0;
    in >> x >> y;
    body.polygon.emplace_back(btScalar(x * cm_per_mm), btScalar(y * cm_per_mm), body.plate);
  }
  return body;
}

/// The body on its support polygon, as thin plates with four of its corners each: Bullet keeps four contact points a
/// convex piece, and so every corner of the polygon bears.
class TiltTable {
 public:
  explicit TiltTable(const Body& body) : dispatcher_(&configuration_) {
    btMatrix3x3 principal = body.inertia;
    btMatrix3x3 axes;
    principal.diagonalize(axes, btScalar(1e-7), 50);
    add_feet(body, axes);
    start_ = btTransform(axes, body.centroid);
    btRigidBody::btRigidBodyConstructionInfo info(1, nullptr, &feet_,
                                                  {principal[0][0], principal[1][1], principal[2][2]});
    info.m_friction = 100;
    info.m_startWorldTransform = start_;
    body_ = std::make_unique<btRigidBody>(info);
    body_->setActivationState(DISABLE_DEACTIVATION);
    plane_ = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), body.plate);
    plane_->setMargin(0);
    table_ = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, plane_.get()));
    table_->setFriction(100);
  }

  /// Leans the table slowly and waits. Seen from the table it is gravity that leans, which is how it is done here.
  bool stands(double direction_rad, double tilt_rad) {
    // A world of its own: nothing is left over from the last question.
    btSequentialImpulseConstraintSolver solver;
    btDiscreteDynamicsWorld world(&dispatcher_, &broadphase_, &solver, &configuration_);
    world.getSolverInfo().m_numIterations = 100;
    // Friction along the slip alone, which is the default, lets a body on a few points creep round sideways.
    world.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    body_->clearForces();
    body_->setLinearVelocity({0, 0, 0});
    body_->setAngularVelocity({0, 0, 0});
    body_->setWorldTransform(start_);
    body_->setInterpolationWorldTransform(start_);
    world.addRigidBody(table_.get());
    world.addRigidBody(body_.get());
    const double duration_s = tilt_rad / ramp_rad_per_s + hold_s;
    bool standing = true;
    for (double t = 0; t < duration_s && standing; t += step_s) {
      const double tilt = std::min(tilt_rad, t * ramp_rad_per_s);
      const btVector3 pull(btScalar(std::sin(tilt) * std::cos(direction_rad)),
                           btScalar(std::sin(tilt) * std::sin(direction_rad)), btScalar(-std::cos(tilt)));
      body_->setGravity(gravity * pull);
      world.stepSimulation(step_s, 0);
      const btQuaternion turned = body_->getOrientation() * start_.getRotation().inverse();
      standing = std::abs(turned.getAngleShortestPath()) < fallen_rad;
    }
    world.removeRigidBody(body_.get());
    world.removeRigidBody(table_.get());
    return standing;
  }

 private:
  void add_feet(const Body& body, const btMatrix3x3& axes) {
    const btScalar thickness = btScalar(0.1);
    feet_.setMargin(0);
    const std::size_t corners = body.polygon.size();
    for (std::size_t first = 0; first < corners; first += 3) {
      auto plate = std::make_unique<btConvexHullShape>();
      plate->setMargin(0);
      for (std::size_t i = first; i < first + std::min<std::size_t>(4, corners); ++i) {
        const btVector3 below = body.polygon[i % corners] - body.centroid;
        plate->addPoint(axes.transpose() * below, false);
        plate->addPoint(axes.transpose() * (below + btVector3(0, 0, thickness)), false);
      }
      plate->recalcLocalAabb();
      feet_.addChildShape(btTransform::getIdentity(), plate.get());
      plates_.push_back(std::move(plate));
    }
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  std::vector<std::unique_ptr<btConvexHullShape>> plates_;
  btCompoundShape feet_;
  btTransform start_;
  std::unique_ptr<btRigidBody> body_;
  std::unique_ptr<btStaticPlaneShape> plane_;
  std::unique_ptr<btRigidBody> table_;
};

}  // namespace

int main() {
  const Body body = read_body(std::cin);
  if (!std::cin || body.polygon.size() < 3) {
    std::cerr << "tilt_table: expects a body with a support polygon on standard input\n";
    return 1;
  }
  TiltTable table(body);
  double direction_rad = 0, tilt_rad = 0;
  while (std::cin >> direction_rad >> tilt_rad) {
    std::cout << (table.stands(direction_rad, tilt_rad) ? "stands" : "falls") << '\n';
  }
}

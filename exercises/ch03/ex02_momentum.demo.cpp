// Demo of exercise 3.2: what gradients achieve with a number of products, with momentum and without. Writes
// descent.csv.
#include <cstdio>
#include <filesystem>
#include <vector>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex02_momentum.hpp"

namespace {

using namespace fc;

RigidBody ball(double x) {
  RigidBody body;
  body.position = {x, 0, 0};
  body.set_mass(sphere_mass(0.5, 2));
  return body;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch03_ex02";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "descent.csv",
                      {{"method", ""}, {"balls", ""}, {"products", ""}, {"fault", "m/s"}});
    for (const int balls : {10, 100}) {
      std::vector<RigidBody> bodies;
      std::vector<lcp::Contact> contacts;
      for (int i = 0; i < balls; ++i) bodies.push_back(ball(i));
      for (int i = 0; i + 1 < balls; ++i)
        contacts.push_back({i, i + 1, {i + 0.5, 0, 0}, Vec3::UnitX(), 0, 1});
      bodies[0].velocity = {1, 0, 0};
      const lcp::ImpactProblem problem = lcp::assemble(bodies, contacts);
      exercises::Products first(bodies, contacts);
      const double largest = exercises::largest_eigenvalue(first, 400);
      for (const bool momentum : {false, true}) {
        for (int products = 1; products <= 4096; products *= 2) {
          exercises::Products A(bodies, contacts);
          const VecX z = momentum ? exercises::momentum_gradients(A, problem.b, largest, products)
                                  : exercises::plain_gradients(A, problem.b, largest, products);
          const VecX w = problem.A * z + problem.b;
          const double fault = problem.A.diagonal().cwiseProduct(z).cwiseMin(w).lpNorm<Eigen::Infinity>();
          table.row({momentum ? "momentum" : "plain", std::int64_t{balls}, std::int64_t{products}, fault});
          if (products == 512) {
            std::printf("%d balls, %s, %d products: %.1e m/s from the answer\n", balls,
                        momentum ? "with momentum" : "plain gradients", products, fault);
          }
        }
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch03_ex02_momentum.py %s\n", folder.string().c_str());
}

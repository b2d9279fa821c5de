// Exercise 5.4, to be seen: how many sweeps stacks need, from below, from above, and with a heavy body on top. Writes
// sweep.csv.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex04_sweep.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch05_ex04";
  constexpr double kSpeed = 9.81 / 60;  // m/s: gravity's in a frame
  constexpr int kMost = 3000;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "sweep.csv",
                      {{"order", ""}, {"bodies", ""}, {"sweep", ""}, {"change", "m/s"}, {"error", ""}});
    for (const char* order : {"from below", "from above", "the top is 100 times as heavy"}) {
      for (const int count : {5, 10, 20}) {
        std::vector<RigidBody> bodies(1);
        std::vector<lcp::Contact> contacts;
        double weight = 0;  // N s, of all
        for (int k = 1; k <= count; ++k) {
          RigidBody body;
          body.position = Vec3(0, 0, k - 0.5);
          body.velocity = Vec3(0, 0, -kSpeed);
          body.set_mass(box_mass({1, 1, 1}, order[0] == 't' && k == count ? 100 : 1));
          weight += body.mass * kSpeed;
          bodies.push_back(body);
          contacts.push_back({k - 1, k, Vec3(0, 0, k - 1.0), Vec3::UnitZ()});
        }
        const bool above = order == std::string("from above");
        if (above) std::reverse(contacts.begin(), contacts.end());
        std::vector<double> approach_limits(contacts.size(), 0), impulses(contacts.size(), 0);
        for (std::int64_t sweeps = 1; sweeps <= kMost; ++sweeps) {
          const double change = exercises::sweep(bodies, contacts, approach_limits, impulses);
          const double floor = above ? impulses.back() : impulses.front();
          if (sweeps <= 50 || sweeps % 20 == 0) table.row({order, count, sweeps, change, 1 - floor / weight});
        }
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch05_ex04_sweep.py %s\n", folder.string().c_str());
}

#include "ex04_beads.hpp"

#include "common/todo.hpp"

namespace fc::exercises {

BeadsResult fly(std::vector<Bead>& beads, double duration) {
  FC_TODO("4.4");
}

}  // namespace fc::exercises

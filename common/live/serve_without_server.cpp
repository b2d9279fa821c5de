// Compiled instead of the server where there is no cpp-httplib.
#include "common/errors.hpp"
#include "common/live/serve.hpp"

namespace fc::live {

int serve(Simulation&, int, bool) {
  throw InputError(
      "--live: this program was built without cpp-httplib; install libcpp-httplib-dev and pkgconf, and build it again");
}

}  // namespace fc::live

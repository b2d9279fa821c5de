// What a chapter's program calls for --live.
#pragma once

#include "common/live/simulation.hpp"

namespace fc::live {

// Runs the simulation, and serves it to pages on this machine at a port (0: any free one), until a page sends the command
// stop, or Ctrl-C or SIGTERM comes; returns the exit code, 0. Prints the page's address on a line of its own; unless quiet,
// how to end it, too. Calls the simulation in this thread. Throws InputError if the port cannot be had.
int serve(Simulation& simulation, int port, bool quiet);

}  // namespace fc::live

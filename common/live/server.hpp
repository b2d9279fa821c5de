// The HTTP server of a live scene (STREAM.md).
#pragma once

#include <memory>
#include <string>

#include "common/live/simulation.hpp"

namespace fc::live {

class Server {
 public:
  // Takes the port (0: any free one) on this machine alone; requests wait until run(). Throws InputError if it cannot be had.
  Server(Simulation& simulation, std::string page, int port);
  ~Server();

  int port() const;
  const std::string& key() const;
  std::string address() const;  // http://127.0.0.1:PORT/?key=KEY

  // Steps the simulation in the calling thread and serves it from others, until stop() or a page's command stop; once.
  void run();
  // From any thread: run() ends within half a second after the frame that has begun.
  void stop();

 private:
  class Http;

  std::unique_ptr<Http> http_;
};

}  // namespace fc::live

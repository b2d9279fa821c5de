#include "common/live/connections.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>

namespace fc::live {

void cut_connections(int port) {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  // The system gives out the smallest free number; the limit itself may be a billion.
  const int end = static_cast<int>(std::min<rlim_t>(limit.rlim_cur, 4096));
  for (int socket = 0; socket < end; ++socket) {
    sockaddr_in own{};
    socklen_t size = sizeof own;
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) != 0)
      continue;  // none, or not a socket
    if (size == sizeof own && own.sin_family == AF_INET && own.sin_addr.s_addr == htonl(INADDR_LOOPBACK) &&
        own.sin_port == htons(static_cast<in_port_t>(port)))
      shutdown(socket, SHUT_RDWR);
  }
}

}  // namespace fc::live

#include "common/live/access.hpp"

#include <fmt/format.h>

#include <random>

namespace fc::live {
namespace {

std::string new_key() {
  std::random_device random;  // the system's own source: 32 bits a call
  std::string key;
  for (int i = 0; i < 4; ++i) key += fmt::format("{:08x}", random());
  return key;
}

}  // namespace

Access::Access(int port) : port_(port), key_(new_key()) {}

std::string Access::address() const {
  return fmt::format("http://127.0.0.1:{}/?key={}", port_, key_);
}

bool Access::is_own_host(std::string_view host) const {
  for (const char* name : {"127.0.0.1", "localhost"}) {
    if (host == fmt::format("{}:{}", name, port_)) return true;
    if (port_ == 80 && host == name) return true;  // the port that browsers leave out
  }
  return false;
}

std::optional<std::string> Access::refuses(const Request& request) const {
  if (request.hosts.size() != 1 || !is_own_host(request.hosts[0]))
    return "Host is not this address; open the one that the program printed";
  constexpr std::string_view scheme = "http://";
  for (const std::string_view origin : request.origins)
    if (!origin.starts_with(scheme) || !is_own_host(origin.substr(scheme.size())))
      return "Origin is not this address; open the one that the program printed";
  if (!request.key || !equal_in_constant_time(*request.key, key_))
    return "the key is missing or wrong; open the address that the program printed";
  return std::nullopt;
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned char differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differences = static_cast<unsigned char>(differences | (a[i] ^ b[i]));
  return differences == 0;
}

}  // namespace fc::live

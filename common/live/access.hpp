// Which requests are let through to a live scene: those of pages that know the printed address. No HTTP here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fc::live {

// The server listens on this machine alone; but any page of any site in the same browser could send it requests, and so could
// every user of the machine. Against both there is a key that nobody can guess. `Host` and `Origin` stop a site whose name
// was made to point at this machine after its page was loaded ("DNS rebinding"), before the key is even compared.
class Access {
 public:
  explicit Access(int port);  // a new key

  const std::string& key() const { return key_; }
  std::string address() const;  // of the page, with its key

  // What a request says of itself: all its Host and Origin headers, and its first key, if it has one.
  struct Request {
    std::vector<std::string> hosts, origins;
    std::optional<std::string> key;
  };
  // Nothing, or why the request is refused: one line.
  std::optional<std::string> refuses(const Request& request) const;

 private:
  bool is_own_host(std::string_view host) const;

  int port_;
  std::string key_;
};

// Whether the texts are equal, in a time that depends on their lengths only: a key cannot be guessed letter by letter.
bool equal_in_constant_time(std::string_view a, std::string_view b);

}  // namespace fc::live

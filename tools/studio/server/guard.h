#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace httplib {
struct Request;
struct Response;
}  // namespace httplib

namespace aplomb::studio {

/// 256 bits from the system's random numbers, as 64 hexadecimal digits. Throws where there are none.
std::string random_token();

/// In a time that does not depend on where they differ.
bool are_equal(std::string_view a, std::string_view b);

/// Who may ask for what: the page that this server gave out, from this machine, and nobody else.
class Guard {
 public:
  Guard(std::string token, int port, std::size_t most_body_bytes);

  /// The HTTP status to refuse a request with, before its body is read; 0: it may pass.
  int refusal(const httplib::Request& request) const;

  std::size_t most_body_bytes() const { return most_body_bytes_; }

 private:
  bool is_own_host(std::string_view host) const;
  bool is_own_origin(std::string_view origin) const;

  std::string token_;
  std::string port_;
  std::size_t most_body_bytes_;
};

/// Puts onto an answer what keeps a browser from doing anything else with it.
void harden(httplib::Response& response);

}  // namespace aplomb::studio

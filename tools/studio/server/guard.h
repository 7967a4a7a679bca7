#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
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

/// A word that lets in once, and not for long: for where others may read it, such as the browser's command line.
class Ticket {
 public:
  const std::string& word() const { return word_; }
  /// \return whether that is it, for the first time, and in time.
  bool take(std::string_view word);

 private:
  std::string word_ = random_token();
  std::chrono::steady_clock::time_point until_ = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  std::mutex mutex_;
  bool is_taken_ = false;
};

/// Who may ask for what: the page that this server gave out, from this machine, and nobody else.
class Guard {
 public:
  Guard(std::string token, int port, std::size_t most_body_bytes);

  /// The HTTP status to refuse a request with, before its body is read; 0: it may pass. Who asks for the token shows a
  /// Ticket instead of it.
  int refusal(const httplib::Request& request) const;

  const std::string& token() const { return token_; }
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

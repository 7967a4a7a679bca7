#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "server/ask.h"
#include "server/guard.h"
#include "server/resident.h"
#include "server/turns.h"
#include "server/whole_run.h"

namespace httplib {
class ContentReader;
class Server;
}  // namespace httplib

namespace aplomb::studio {

/// Where what the server needs lies.
struct Places {
  std::filesystem::path program;   ///< this one
  std::filesystem::path aplomb;    ///< the command line's
  std::filesystem::path page;      ///< the folder of the built page
  std::filesystem::path fixtures;  ///< the folder of fixtures; empty: none
  std::filesystem::path models;    ///< a folder to write to
};

/// What a request of README.md's protocol does.
class Routes {
 public:
  Routes(Places places, Guard guard, std::function<void()> quit);

  /// \pre this outlives the server's run.
  void add_to(httplib::Server& server);

  /// Begins with a model or a job, as the command line names it. \return file_system; as read_job().
  Result<void> begin_with(const std::filesystem::path& file);

  /// What the browser is opened with.
  const std::string& ticket() const { return ticket_.word(); }

  /// Ends all that runs; nothing begins any more.
  void close() { turns_.cancel_all(true); }

 private:
  void add_streams(httplib::Server& server);
  void start(httplib::Response& response);
  void give_token(httplib::Response& response, const Ask& ask);
  void take_model(const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& reader);
  void take_profile(const httplib::Request& request, httplib::Response& response, const httplib::ContentReader& reader);
  void take_fixture(httplib::Response& response, const Ask& ask);
  void take_away(httplib::Response& response, const Ask& ask);
  void stream(httplib::Response& response, const Ask& ask, Errand errand);
  void answer(const Ask& ask, const Work& work, Errand errand, Stream& stream);
  void stand(const Ask& ask, const Work& work, Stream& stream);
  void validate_result(const Ask& ask, const Work& work, Stream& stream);

  /// The body where it is short enough; else the response says so.
  std::optional<Ask> read_ask(httplib::Response& response, const httplib::ContentReader& reader);
  /// A file that comes as a body, whole; else the response says why not.
  std::optional<Upload> receive(Uploads& uploads, const httplib::Request& request, httplib::Response& response,
                                const httplib::ContentReader& reader);
  /// What a request is about, where it is still there; else the response says so.
  std::optional<Work> work_of(const Ask& ask, httplib::Response& response);
  /// The last run, where it was of this job. \pre made_mutex_ is held.
  std::optional<Made> made_of(const Ask& ask);
  /// A file of the user's own, found from now on.
  static Result<Upload> copy_of(Uploads& uploads, const std::filesystem::path& file);

  Places places_;
  Guard guard_;
  Ticket ticket_;
  std::function<void()> quit_;
  Uploads models_, profiles_;
  Turns turns_;
  Resident resident_;

  std::optional<Upload> begun_, begun_profile_;  // with, by the command line
  std::string begun_job_;                        // empty: none

  std::mutex made_mutex_;
  std::optional<Made> made_;
  Ask made_of_;
  int runs_ = 0;
};

}  // namespace aplomb::studio

#include "server/whole_run.h"

#include <sys/wait.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "aplomb/ending.h"
#include "wire/messages.h"

namespace aplomb::studio {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr auto grace = std::chrono::seconds(3);  // between asking it to end and ending it

/// What the program says on standard error: lines of progress, and words.
class Listener {
 public:
  explicit Listener(Stream& stream) : stream_(stream) {}

  void hear(const std::string& talk) {
    line_ += talk;
    for (std::size_t end = 0; (end = line_.find('\n')) != std::string::npos; line_.erase(0, end + 1))
      take(line_.substr(0, end));
  }
  /// The first line that was no progress: the verdict, of a run that came to one.
  const std::string& verdict() const { return verdict_; }
  const std::string& words() const { return words_; }

 private:
  void take(const std::string& line) {
    if (line.starts_with("{\"progress\"")) {
      const Json told = Json::parse(line, nullptr, false);
      if (told.is_object())
        stream_.json(progress_message(told.value("progress", 0.0), told.value("stage", std::string())));
      return;
    }
    if (verdict_.empty() && !line.starts_with("aplomb: ")) verdict_ = line;
    words_ += line + '\n';
  }

  Stream& stream_;
  std::string line_, verdict_, words_;
};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Puts the model, the profile and the job into the run's folder. \return whether that went well.
bool prepare(const Made& made, const Work& work) {
  std::error_code failed;
  fs::create_directory(made.folder, failed);
  if (!failed) fs::create_hard_link(work.model.file(), made.folder / work.model.name, failed);
  if (!failed && work.profile) fs::create_hard_link(work.profile->file(), made.folder / work.profile_name(), failed);
  std::ofstream job(made.job());
  job << job_text(work, JobReader::run) << std::flush;
  return !failed && job;
}

std::string ended_message(int code, const std::string& sentence) {
  return Json{{"type", "ended"}, {"code", code}, {"message", sentence}}.dump(-1, ' ', false,
                                                                             Json::error_handler_t::replace);
}

/// One run of the program, told to a stream.
class WholeRun {
 public:
  WholeRun(const Made& made, Stream& stream, Resident& resident, const std::function<void()>& on_written)
      : made_(made), stream_(stream), resident_(resident), on_written_(on_written), listener_(stream) {}

  /// \return whether it came to its end, standing or not.
  bool follow(Child& child) {
    std::optional<std::chrono::steady_clock::time_point> told_to_end;
    std::optional<int> status;
    while (!(status = child.ended(0))) {
      listener_.hear(child.talk(50));
      stream_.stay_alive();
      if (!told_to_end && !is_shown_ && fs::exists(made_.report())) show_result(child);
      if (!told_to_end && (is_broken_ || stream_.is_over())) {
        told_to_end = std::chrono::steady_clock::now();
        child.interrupt();
      }
      if (told_to_end && std::chrono::steady_clock::now() - *told_to_end > grace) child.kill();
    }
    if (is_broken_) return false;
    if (told_to_end || (WIFEXITED(*status) && WEXITSTATUS(*status) == static_cast<int>(Ending::cancelled))) {
      stream_.json(cancelled_message());
      return false;
    }
    return finish(child, *status);
  }

 private:
  /// As soon as it is there: the run goes on to draw its page.
  void show_result(Child& child) {
    is_shown_ = true;
    listener_.hear(child.talk(0));
    stream_.json(wrapped_message("report", "report", text_of(made_.report()), listener_.verdict()));
    if (!fs::exists(made_.mesh())) return;
    const SolverRequest read_back{.what = "result",
                                  .folder = made_.folder.string(),
                                  .job = {},
                                  .file = made_.mesh().filename().string(),
                                  .dense = made_.dense().filename().string(),
                                  .stl = made_.stl().filename().string()};
    is_broken_ = !resident_.answer(read_back, stream_);
    if (is_broken_) return;
    on_written_();
    stream_.json(written_message());
  }

  bool finish(Child& child, int status) {
    listener_.hear(child.talk(0));
    if (WIFEXITED(status) && !is_shown_ && fs::exists(made_.report())) show_result(child);
    if (is_broken_) return false;
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(Ending::internal);
    if (!WIFEXITED(status) || !fs::exists(made_.page())) {
      stream_.json(error_message(code, last_words(listener_.words(), status)));
      return false;
    }
    stream_.json(ended_message(code, listener_.verdict()));
    return true;
  }

  const Made& made_;
  Stream& stream_;
  Resident& resident_;
  const std::function<void()>& on_written_;
  Listener listener_;
  bool is_shown_ = false;
  bool is_broken_ = false;  // the stream has been told why
};

}  // namespace

bool run_whole(const RunOrder& order, Stream& stream, Resident& resident, const std::function<void()>& on_written) {
  const Made& made = order.made;
  if (!prepare(made, order.work)) {
    stream.json(error_message(static_cast<int>(Ending::unusable_input), "there is no place for the run"));
    return false;
  }
  auto child = Child::start({order.program.string(), "run", made.job().filename().string(), "--progress", "json",
                             "--report", made.report().filename().string(), "--html", made.page().filename().string()},
                            made.folder);
  if (!child) {
    stream.json(error_message(child.error()));
    return false;
  }
  return WholeRun(made, stream, resident, on_written).follow(*child);
}

}  // namespace aplomb::studio

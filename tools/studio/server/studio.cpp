#include "server/studio.h"

#include <fmt/format.h>
#include <httplib.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <linux/close_range.h>
#endif

#include <array>
#include <cerrno>
#include <chrono>
#include <iostream>
#include <thread>

#include "aplomb/ending.h"
#include "server/guard.h"
#include "server/private_folder.h"
#include "server/routes.h"

namespace aplomb::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t workers = 16;  // a stream keeps one busy

/// The first of the places that is there; empty: none.
fs::path first_of(std::initializer_list<fs::path> places) {
  for (const fs::path& place : places)
    if (fs::exists(place)) return place;
  return {};
}

Places places_of(const fs::path& program, const fs::path& models) {
  const fs::path folder = program.parent_path();
  return {.program = program,
          .aplomb = first_of({folder / "aplomb", folder.parent_path() / "cli/aplomb"}),
          .page = folder / "page",
          .fixtures = first_of({folder / "fixtures", fs::path(APLOMB_FIXTURES)}),
          .models = models};
}

/// Shows an address in the user's browser, where there is one; whoever has none reads it on the terminal.
void open_browser(const std::string& address) {
  if (const pid_t id = fork(); id == 0) {
    if (fork() != 0) _exit(0);  // init takes care of the other
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    signal(SIGPIPE, SIG_DFL);
    setsid();  // Ctrl-C is for the server
#ifdef __linux__
    close_range(3, ~0U, 0);  // a browser that goes on running must not hold the port
#endif
#ifdef __APPLE__
    constexpr const char* opener = "open";
#else
    constexpr const char* opener = "xdg-open";
#endif
    execlp(opener, opener, address.c_str(), nullptr);
    _exit(127);
  } else if (id > 0) {
    waitpid(id, nullptr, 0);
  }
}

sigset_t ending_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, number);
  return set;
}

int complain(const Error& error) {
  std::cerr << "aplomb: " << error.message << '\n';
  return static_cast<int>(ending_of(error));
}

}  // namespace

int run_studio(const StudioOptions& options) {
  const sigset_t endings = ending_signals();
  pthread_sigmask(SIG_BLOCK, &endings, nullptr);  // of all threads to come; one waits for them
  httplib::Server server;
  server.new_task_queue = [] { return new httplib::ThreadPool(workers); };  // the server deletes it
  server.set_keep_alive_max_count(1);  // what follows a body that was refused is no request
  server.set_tcp_nodelay(true);
  server.set_socket_options([](int socket) {  // the library's own would share the port with others
    const int on = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  });
  server.set_write_timeout(30);
  constexpr const char* host = "127.0.0.1";
  const int port = options.port == 0 ? server.bind_to_any_port(host) : options.port;
  if (port <= 0 || (options.port != 0 && !server.bind_to_port(host, port)))
    return complain({ErrorCode::invalid_option, fmt::format("port {} {}; leave --port out", options.port,
                                                            errno == EACCES ? "is not for this user" : "is taken")});

  const PrivateFolder folder;
  const Places places = places_of(options.program, folder.path());
  if (places.aplomb.empty())
    return complain({ErrorCode::internal, "there is no aplomb beside " + options.program.string()});
  const std::string token = random_token();
  Routes routes(places, Guard(token, port, options.most_upload_bytes), [] { kill(getpid(), SIGTERM); });
  if (!options.given.empty())
    if (const auto begun = routes.begin_with(options.given); !begun) return complain(begun.error());
  routes.add_to(server);

  const std::string address = fmt::format("http://{}:{}/#", host, port);
  fmt::print("Aplomb Studio: {}{}\nIt ends with Ctrl-C.\n", address, token);
  std::fflush(stdout);
  if (options.opens_browser) open_browser(address + "once-" + routes.ticket());
  std::thread([&server, &routes, endings] {
    int number = 0;
    sigwait(&endings, &number);
    routes.close();
    while (!server.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    server.stop();  // nothing, before it runs
  }).detach();
  return server.listen_after_bind() ? 0 : static_cast<int>(Ending::internal);
}

}  // namespace aplomb::studio

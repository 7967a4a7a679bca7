#include <exception>
#include <iostream>
#include <new>
#include <string_view>

#include "interrupt.h"
#include "run.h"
#include "studio.h"

int main(int argc, char** argv) {
  using namespace aplomb::cli;
  if (argc > 1 && std::string_view(argv[1]) == "studio") return become_studio(argc, argv);
  const Parsed parsed = parse_arguments(argc, argv);
  if (!parsed.arguments) return parsed.exit_code;
  catch_interrupts(cancelled_exit);
  try {
    return run(*parsed.arguments);
  } catch (const std::bad_alloc&) {
    std::cerr << "aplomb: memory ran out\n";
    return 5;
  } catch (const std::exception& error) {  // a bug
    std::cerr << "aplomb: internal error: " << error.what() << '\n';
    return 7;
  }
}

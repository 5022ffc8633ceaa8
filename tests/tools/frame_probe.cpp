// tests/tools/frame_probe.cpp
// The smallest tool that can be made with the frame: copies a file, or ends as asked for.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "tools/frame/tool.hpp"

int main(int argc, char** argv) {
  std::string source, target, second, mode = "copy";
  double factor_m = 0.5;
  talus::Tool tool("frame-probe", "Copies a file.");
  tool.input("source", source, "file to copy");
  tool.output("-o,--out", target, "where to").required();
  tool.output("--second", second, "another copy");
  tool.option("--mode", mode, "copy, refuse, fail, break, check, throw, wait or hold");
  tool.option("--factor-m", factor_m, "a number [m]");
  return tool.run(argc, argv, [&] {
    for (const std::string& path : {target, second})
      if (!path.empty()) std::filesystem::copy_file(source, tool.stage(path));
    if (mode == "refuse") throw talus::InputError({source, 3}, "found a, expected b", "write b");
    if (mode == "fail") throw talus::NumericsError("the energy grew");
    if (mode == "throw") throw std::runtime_error("a surprise");
    if (mode == "check") tool.check("largest_penetration_m", 2, 1, false);
    if (mode == "wait") {
      const auto tell = tool.progress();
      for (int i = 0; i < 600; ++i) {
        tell(i / 600.0);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    }
    if (mode == "hold")
      while (std::filesystem::exists("hold"))
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    tool.warn("a warning");
    tool.metric("n_bytes", static_cast<double>(std::filesystem::file_size(source)), "1");
    tool.result({{"run_id", tool.run_id()}}, "copied");
  });
}

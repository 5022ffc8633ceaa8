// Reads design codes and barrier classes of share/codes for the tools for fences.
#include "tools/frame/fence_code.hpp"

#include <filesystem>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/sha256.hpp"
#include "tools/frame/shipped_data.hpp"

namespace talus {

FenceCode read_fence_code(const std::string& name) {
  const bool shipped = name == "uni" || name == "onr";
  const std::string file = name == "uni" ? "codes/uni_11211-4.csv" : "codes/onr_24810.csv";
  FenceCode out;
  out.classes = barrier_classes(
      parse_csv(shipped_data("codes/barrier_classes.csv"), "share/codes/barrier_classes.csv"));
  if (!shipped && !std::filesystem::exists(name))
    throw InputError({"", 0, "--code"}, "is \"" + name + "\", which is not a file",
                     "give uni, onr, or a data file like those of share/codes/");
  if (shipped) {
    Sha256 hash;
    hash.add(shipped_data(file).data(), shipped_data(file).size());
    out.code = design_code(parse_csv(shipped_data(file), "share/" + file));
    out.sha256 = hash.hex();
  } else {
    out.code = design_code(read_csv(name));
    out.sha256 = sha256_of_file(name);
  }
  return out;
}

}  // namespace talus

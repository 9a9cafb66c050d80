#include "hexfield/io/format.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "hexfield/base/error.hpp"
#include "scanner.hpp"

namespace hexfield {
namespace {

constexpr std::pair<std::string_view, MeshFormat> names[] = {
    {"vtk", MeshFormat::vtk},     {"vtu", MeshFormat::vtu},    {"msh", MeshFormat::msh41},
    {"msh41", MeshFormat::msh41}, {"msh4", MeshFormat::msh41}, {"msh22", MeshFormat::msh22},
    {"msh2", MeshFormat::msh22},  {"mesh", MeshFormat::medit}, {"inp", MeshFormat::abaqus}};

}  // namespace

std::optional<MeshFormat> format_of_name(std::string_view name) {
  if (name.starts_with('.')) name.remove_prefix(1);
  const std::string wanted = io::lower(name);
  for (const auto& [text, format] : names)
    if (text == wanted) return format;
  return std::nullopt;
}

std::string extension_of(MeshFormat format) {
  switch (format) {
    case MeshFormat::vtk:
      return ".vtk";
    case MeshFormat::vtu:
      return ".vtu";
    case MeshFormat::msh41:
      return ".msh";
    case MeshFormat::msh22:
      return ".msh2";
    case MeshFormat::medit:
      return ".mesh";
    case MeshFormat::abaqus:
      return ".inp";
  }
  return "";
}

std::vector<std::string> format_names() {
  std::vector<std::string> all;
  for (const auto& [text, format] : names) all.emplace_back(text);
  return all;
}

MeshFormat choose_format(const std::filesystem::path& file, const WriteOptions& options) {
  if (options.format) return *options.format;
  if (const auto format = format_of_name(file.extension().string())) return *format;
  throw Error(ExitCode::usage, fmt::format("{}: its extension names no format that can be written; known are: {}.",
                                           file.string(), fmt::join(format_names(), ", ")));
}

}  // namespace hexfield

// All ways in which editors save a file.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "temporary_folder.hpp"

namespace frontend {

/// The way in which an editor saves `text` as the file NAME of a folder.
struct Save {
  const char* name;
  void (*write)(const TemporaryFolder& folder, const std::string& name, const std::string& text);
};

inline const Save kSaves[] = {
    {"TruncatingAndWriting", [](const TemporaryFolder& folder, const std::string& name,
                                const std::string& text) { folder.write(name, text); }},
    {"RenamingANewFileOverIt",
     [](const TemporaryFolder& folder, const std::string& name, const std::string& text) {
       std::filesystem::rename(folder.write(".new", text), folder / name);
     }},
    {"MovingTheOldOneToABackup",
     [](const TemporaryFolder& folder, const std::string& name, const std::string& text) {
       std::filesystem::rename(folder / name, folder / (name + "~"));
       folder.write(name, text);
     }},
    {"MovingTheOldOneAwayAndRemovingIt",
     [](const TemporaryFolder& folder, const std::string& name, const std::string& text) {
       std::filesystem::rename(folder / name, folder / "4913");
       folder.write(name, text);
       std::filesystem::remove(folder / "4913");
     }},
    {"RemovingAndWritingAnew",
     [](const TemporaryFolder& folder, const std::string& name, const std::string& text) {
       std::filesystem::remove(folder / name);
       folder.write(name, text);
     }},
    {"SeveralQuickWrites",
     [](const TemporaryFolder& folder, const std::string& name, const std::string& text) {
       folder.write(name, "");
       for (const char c : text) {
         std::ofstream(folder / name, std::ios::app) << c;
       }
     }},
    {"CopyingBackWhatWasMoved",
     [](const TemporaryFolder& folder, const std::string& name, const std::string& text) {
       std::filesystem::rename(folder / name, folder / "old");
       std::filesystem::copy_file(folder / "old", folder / name);
       folder.write(name, text);
     }},
};

}  // namespace frontend

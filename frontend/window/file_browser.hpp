// A folder's designs and folders, of which a text that is typed and keys choose one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace window {

class FileBrowser {
 public:
  struct Entry {
    std::string name;
    bool is_folder = false;
  };

  /// Starts in a folder, or in the working one if `folder` is empty.
  explicit FileBrowser(const std::string& folder);

  /// Returns the absolute path of the folder whose entries are shown.
  const std::string& folder() const { return folder_; }
  /// Returns what can be chosen: the folder above, the folders, then the designs, by their names;
  /// those whose names contain the text. Names that begin with a dot are left out unless the text
  /// begins with one.
  const std::vector<Entry>& entries() const { return shown_; }
  /// Returns the index of the chosen entry; 0 if there is none.
  std::size_t chosen() const { return chosen_; }
  /// Returns why the folder cannot be read, or that there is no such file; empty: nothing is wrong.
  const std::string& problem() const { return problem_; }
  const std::string& text() const { return text_; }

  /// Takes the text as it is typed. Up to its last slash it is a path, in which "~" is the home
  /// folder, to the folder that is shown. Chooses the entry whose name is the rest, or else begins
  /// with it.
  void type(const std::string& text);
  /// Returns the text completed to the chosen entry's name.
  std::string completed() const;
  /// Chooses an entry.
  void choose(std::size_t entry);
  /// Chooses the entry that is so many further on, at most the last.
  void move(int by);
  void go_up();
  /// Goes into the folder, or returns the path of the file, that the text names, whether or not it
  /// is shown; or else the chosen one.
  std::optional<std::string> enter();

 private:
  void go_to(const std::string& folder);
  void show(const std::string& folder);
  void filter();

  std::string base_;    // where the text begins
  std::string folder_;  // where the text leads to
  std::string text_;
  std::size_t rest_ = 0;  // the text from here on is a part of a name
  std::string problem_;
  std::vector<Entry> all_;
  std::vector<Entry> shown_;
  std::size_t chosen_ = 0;
  bool is_chosen_ = false;  // by the user, since the text was typed
};

}  // namespace window

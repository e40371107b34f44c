# project_files: the files of the project in the working folder: those that git knows or would add; in an unpacked
# archive, everything but build folders.
project_files() {
  { [ -e .git ] && git ls-files -co --exclude-standard 2>/dev/null; } ||
    find . \( -path ./build -o -path ./.cache -o -path ./.git -o -type d -exec test -e {}/CMakeCache.txt \; \) \
      -prune -o -type f -printf '%P\n'
}

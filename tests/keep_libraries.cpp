// Part of every program of a sanitized build. A graphics driver that is unloaded before the process
// ends takes its globals with it, and what they point to looks leaked, with a stack that no
// suppression can name. So nothing is unloaded.
extern "C" int dlclose(void*) { return 0; }

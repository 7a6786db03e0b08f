// Under LeakSanitizer a report is matched to a suppression by the name of the library it came from.
// Open MPI unloads its components before the end, and their names with them; here nothing is
// unloaded.

extern "C" int dlclose(void* /*handle*/) { return 0; }

#!/usr/bin/env python3
"""The judge is judged: a small tree with one violation of each rule, and one with none."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check  # noqa: E402

HEAD = "#pragma once\n"


def judged(files):
    """The sentences about a tree given as {path: text}."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            os.makedirs(os.path.dirname(os.path.join(root, path)) or root, exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        return [f"{path}:{line}: {what}" for path, line, what in check.violations(root)]


class Layers(unittest.TestCase):
    def flags(self, files, fragment):
        found = judged(files)
        self.assertEqual(len(found), 1, found)
        self.assertIn(fragment, found[0])

    def passes(self, files):
        self.assertEqual(judged(files), [])

    def test_downward_includes_pass(self):
        self.passes({"libfsi/core/a.hpp": HEAD, "libfsi/mesh/b.hpp": HEAD,
                     "libfsi/vof/c.hpp": HEAD + '#include "libfsi/core/a.hpp"\n'
                                                '#include "libfsi/mesh/b.hpp"\n'})

    def test_upward_include(self):
        self.flags({"libfsi/vof/c.hpp": HEAD,
                    "libfsi/core/a.hpp": HEAD + '#include "libfsi/vof/c.hpp"\n'},
                   "vof is above core")

    def test_sibling_include(self):
        self.flags({"libfsi/vof/c.hpp": HEAD,
                    "libfsi/solid/a.hpp": HEAD + '#include "libfsi/vof/c.hpp"\n'},
                   "vof is a sibling of solid")

    def test_include_in_a_comment_counts_for_nothing(self):
        self.passes({"libfsi/core/a.hpp": HEAD + '// #include "libfsi/vof/c.hpp"\n'})

    def test_include_path_is_the_repository_path(self):
        self.flags({"libfsi/core/a.hpp": HEAD,
                    "libfsi/core/b.hpp": HEAD + '#include "a.hpp"\n'}, "not a path")

    def test_a_driver_includes_one_header(self):
        self.flags({"libfsi/core/a.hpp": HEAD,
                    "drivers/x.cpp": '#include "libfsi/core/a.hpp"\n'}, "libfsi/fsi.hpp only")

    def test_petsc_header_outside(self):
        self.flags({"libfsi/vof/c.hpp": HEAD + "#include <petscvec.h>\n"}, "PETSc header")

    def test_petsc_call_outside(self):
        self.flags({"libfsi/vof/c.hpp": HEAD + "inline void f() { FSI_PETSC(VecSet(v, 0)); }\n"},
                   "VecSet outside its homes")

    def test_petsc_call_unchecked(self):
        self.flags({"libfsi/io/c.hpp": HEAD + "inline void f() {\n  VecSet(v, 0);\n}\n"},
                   "c.hpp:3: the code of VecSet is not checked")

    def test_petsc_call_unchecked_after_a_condition(self):
        self.flags({"libfsi/io/c.hpp": HEAD + "inline void f() { if (v) VecSet(v, 0); }\n"},
                   "VecSet is not checked")

    def test_petsc_calls_checked(self):
        self.passes({"libfsi/io/c.hpp": HEAD + "inline int f() {\n"
                     "  FSI_PETSC(VecSet(v, PetscReal(0)));\n"
                     "  FSI_PETSC(\n      VecScale(v, 2));\n"
                     "  const int code = VecSet(v, 1);\n"
                     "  if (VecSet(v, 1) != 0) return 1;\n"
                     "  static_cast<void>(VecDestroy(&v));\n"
                     "  // VecSet(v, 0);\n"
                     "  say(\"VecSet(v, 0);\");\n"
                     "  return VecSet(v, code);\n}\n"})

    def test_long_function(self):
        body = "  x = 1;\n"
        self.passes({"libfsi/core/a.hpp": HEAD + "inline void f() {\n" + 58 * body + "}\n"})
        self.flags({"libfsi/core/a.hpp": HEAD + "inline void f(int a = {}) {\n" + 59 * body + "}\n"},
                   "function f has 61 lines")
        self.flags({"libfsi/core/a.hpp": HEAD + "namespace fsi {\nclass A {\n  A() : x_{1} {\n" +
                    59 * body + "  }\n};\n}\n"}, "61 lines")

    def test_long_files(self):
        self.flags({"libfsi/core/a.hpp": HEAD + 400 * "\n"}, "401 lines, more than 400")
        self.flags({"drivers/a.cpp": 61 * "\n"}, "61 lines, more than 60")

    def test_inheritance(self):
        self.flags({"libfsi/core/a.hpp": HEAD + "class A : public B {};\n"}, "inheritance from")
        self.passes({"libfsi/core/a.hpp": HEAD + "class A : public std::runtime_error {};\n"
                                                 "enum class K : int { a };\n"
                                                 "struct A::B {};\n"})

    def test_words_of_code(self):
        for text, what in (("int* p = new int;", "new is not used"),
                           ("struct A { virtual void f(); };", "virtual is not used"),
                           ("int get_x();", "get_"), ("int neighbor;", "neighbour"),
                           ("using namespace std;", "using namespace")):
            self.flags({"libfsi/core/a.hpp": HEAD + text + "\n"}, what)
        self.passes({"libfsi/core/a.hpp": HEAD + "struct A { A(A&) = delete; };  // a new one\n"})

    def test_no_pragma_once(self):
        self.flags({"libfsi/core/a.hpp": "int x;\n"}, "#pragma once")

    def test_paths_of_one_machine(self):
        for folder in ("work", "root", "home", "tmp"):
            self.flags({"doc/a.md": f"see /{folder}/main\n"}, "a path of one machine")
        self.passes({"doc/a.md": "see doc/work/a and https://example.org/home\n"})

    def test_left_open(self):
        self.flags({"doc/a.md": "TO" "DO: all\n"}, "left open")

    def test_works_cited(self):
        code = HEAD + "// by midpoints  [Bach" "50] (2)\n"
        listed = {"doc/references.md": "| Bach" "50 | J. S. Bach |\n"}
        self.flags({"libfsi/core/a.hpp": code}, "is not in doc/references.md")
        self.passes({"libfsi/core/a.hpp": code, **listed})

    def test_source_lists(self):
        listed = "target_sources(fsi PRIVATE a.cpp b.cpp)\n"
        self.passes({"libfsi/core/CMakeLists.txt": listed, "libfsi/core/a.cpp": "",
                     "libfsi/core/b.cpp": ""})
        self.flags({"libfsi/core/CMakeLists.txt": listed, "libfsi/core/a.cpp": "",
                    "libfsi/core/b.cpp": "", "libfsi/core/c.cpp": ""}, "c.cpp is not in the list")
        self.flags({"libfsi/core/CMakeLists.txt": "target_sources(fsi PRIVATE b.cpp a.cpp)\n",
                    "libfsi/core/a.cpp": "", "libfsi/core/b.cpp": ""}, "not sorted")


if __name__ == "__main__":
    unittest.main()

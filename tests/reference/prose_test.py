#!/usr/bin/python3
"""The judges of the documents judged: sentences, links that lead nowhere, what a page of verification holds."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import comments  # noqa: E402
import links  # noqa: E402
import pages  # noqa: E402
import prose  # noqa: E402


def counts(text):
    return [len(prose.words(sentence)) for _, sentence in prose.sentences(text)]


class Sentences(unittest.TestCase):
    def test_end_at_their_stops(self):
        self.assertEqual(counts("One two. Three four five! `Six` seven?\n"), [2, 3, 2])
        self.assertEqual(counts("The [link. Or so](a/b.md) leads on, e.g. To there.\n"), [2, 7])
        self.assertEqual(counts("Version 1.2 of it.\n"), [4])

    def test_go_on_over_lines(self):
        self.assertEqual(counts("one two\nthree.\nFour\n\nfive\n"), [3, 1, 1])
        self.assertEqual([line for line, _ in prose.sentences("# A\n\nb\nc\n\nd\n")], [1, 3, 6])

    def test_stop_at_items_heads_and_cells(self):
        self.assertEqual(counts("# A head\n- one two\n  three\n- four\n1. five\n"), [2, 3, 1, 1])
        self.assertEqual(counts("text\n| a b | c \\| d |\n|---|---|\n"), [1, 2, 2, 0, 0])

    def test_leave_code_out(self):
        self.assertEqual(counts("one\n\n```\ntwo three. Four\n```\n\nfive\n"), [1, 1])
        self.assertEqual(counts("one:\n\n    x = a b c\n\n    y\n\nfive `a b c d` six\n"), [1, 3])


def comment_counts(text, language):
    return [len(prose.words(sentence)) for _, sentence in comments.sentences(text, language)]


class Comments(unittest.TestCase):
    def test_of_cpp_go_on_over_lines(self):
        text = '/// One two.\n/// phi is three\n/// four.\n///\n/// Five\nint i = 0;  // six\n'
        self.assertEqual(comment_counts(text, "c++"), [2, 4, 1, 1])
        self.assertEqual([line for line, _ in comments.sentences(text, "c++")], [1, 1, 5, 6])

    def test_behind_code_stand_alone(self):
        self.assertEqual(comment_counts("int i;  ///< one\nint j;  ///< two three\n", "c++"), [1, 2])
        self.assertEqual(comment_counts("int i;  // one\n        // two\n        int j;  // three\n", "c++"), [2, 1])

    def test_are_no_strings(self):
        self.assertEqual(comment_counts('f("a // b");\ng("//", \'"\');  // one\n', "c++"), [1])

    def test_count_a_formula_as_a_word(self):
        self.assertEqual(comment_counts("/// It is\n///   a = b + c + d,\n/// with b\n", "c++"), [5])
        self.assertEqual(comment_counts("/// It is\n///   a = b + c.\n/// With b\n", "c++"), [3, 2])
        self.assertEqual(comment_counts("/// Where\n/// |u| is 0\n", "c++"), [4])
        self.assertEqual(comment_counts("/// Where a . b is 0. alpha is one\n", "c++"), [5, 3])

    def test_of_python(self):
        text = '#!/usr/bin/python3\n"""One two.\n\n    code a b c\n\nThree"""\n# four\n# five.\ndef f():\n    "Six."\n'
        self.assertEqual(comment_counts(text, "python"), [2, 1, 2, 1])

    def test_of_other_files_are_not_read(self):
        self.assertEqual(comments.language("a/run", "#!/usr/bin/python3\n"), "python")
        self.assertEqual(comments.language("a/b.hpp", ""), "c++")
        for name, text in (("run", "#!/usr/bin/env bash\n"), ("a.md", ""), ("CMakeLists.txt", "")):
            self.assertIsNone(comments.language(name, text))


class Links(unittest.TestCase):
    def test_lead_to_files_and_heads(self):
        with tempfile.TemporaryDirectory() as folder:
            page = os.path.join(folder, "a.md")
            with open(page, "w", encoding="utf-8") as file:
                file.write("# A `b_c` head: x\n")
            for link in ("a.md", "a.md#a-b_c-head-x", "#a-b_c-head-x", "https://a.b/c", "."):
                self.assertEqual(list(links.faults(page, f"x\n[y]({link})\n")), [], link)
            for link in ("b.md", "a.md#b", "#b", "../nowhere/"):
                self.assertEqual(list(links.faults(page, f"x\n[y]({link})\n")), [(2, link)])
            self.assertEqual(list(links.faults(page, "```\n[y](b.md)\n```\n`[y](b)`\n")), [])


class Pages(unittest.TestCase):
    TABLE = "| a | b |\n|---|---|\n" + 15 * "| 1 | 2 |\n"
    PAGE = "# A\n\n" + TABLE + "\n![x](a.png)\n\n    ctest -R a\n"

    def test_hold_one_table_one_picture_and_a_command(self):
        self.assertEqual(list(pages.faults(self.PAGE)), [])
        self.assertEqual(list(pages.faults(self.PAGE.replace("    ctest -R a", "```\nfsi-mesh check a\n```"))), [])
        for faulty in (self.PAGE + "\n" + self.TABLE, self.PAGE.replace(self.TABLE, ""),
                       self.PAGE.replace(self.TABLE, self.TABLE + "| 1 | 2 |\n"), self.PAGE + "![y](b.png)\n",
                       self.PAGE.replace("!", ""), self.PAGE.replace("    ctest", "ctest"),
                       self.PAGE.replace("ctest -R a", "U = g a"), self.PAGE + 150 * "\n"):
            self.assertEqual(len(list(pages.faults(faulty))), 1, faulty)

    def test_have_the_picture_of_their_table(self):
        for content, faults in ((pages.mark(self.TABLE), 0), (pages.mark(self.TABLE + "| 3 |\n"), 1), ("", 0)):
            self.assertEqual(len(list(pages.faults(self.PAGE, lambda _, c=content: c.encode()))), faults)


if __name__ == "__main__":
    unittest.main()

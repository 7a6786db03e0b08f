// MathJax 2.7, as Debian has it: formulas stand in elements of the class arithmatex alone.
window.MathJax = {
  messageStyle: "none",
  showMathMenu: false,
  tex2jax: {processClass: "arithmatex", ignoreClass: ".*|", displayMath: [["\\[", "\\]"]]},
};

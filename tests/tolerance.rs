//! Every tolerance of the tests, each with its reason. Relative to the size of the value unless said.

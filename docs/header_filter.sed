# SPDX-License-Identifier: LGPL-3.0-or-later
# A filter for Doxygen, by sed -E -f: what a function costs is a paragraph of its own, not a part of the exception above it.
s|^( *)/// Cost: |\1///\n\1/// \\par Cost\n\1/// |
# Private structures: they would be announced, and not described.
/^ private:$/,/^};$/{
  /^  (struct|class) .*\{$/,/^  };$/d
}

# Makes the links of our pages, which are those of the repository, links of the site that Doxygen makes of them.

# The header of a class is its page.
s#\]\((\.\./)?[A-Za-z]+/(vtk[A-Za-z]+)\.h\)#](@ref \2)#g
# Files lie beside the pages.
s#\]\((\.\./)?(Examples|Testing)/([A-Za-z]+/)*([A-Za-z_]+\.[a-z]+)\)#](\4)#g
s#\]\((\.\./)?(LICENSE|pyproject\.toml)\)#](./\2)#g
# Doxygen 1.9.4 gives headings ids of its own.
s#\[([^]]*)\]\(\#[^)]*\)#\1#g
s#(\]\([^):]*\.md)\#[^)]*\)#\1)#g
# It takes a quote in code for the end of the code, unless there are two backquotes.
s#^(([^`]*`[^`']*`)*[^`]*)`([^`]*'[^`]*)`#\1``\3``#

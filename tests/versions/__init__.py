"""The same bytes under every supported version of Python and of the libraries."""

"""Reports: terminal tables, calculation notes, HTML reports of lines."""

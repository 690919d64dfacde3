"""What fans, pumps, compressors and stirrers take."""

"""What users import and type: client, figures, command line."""

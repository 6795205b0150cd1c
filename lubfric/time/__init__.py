"""What changes in time: histories, the march, films and contacts in time."""

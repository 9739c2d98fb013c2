"""The studio's great hall: its stone, mosaic and baked light."""

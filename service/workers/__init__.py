"""Workers: who is alive; of those that joined over HTTPS: blocks, files and attempts."""
